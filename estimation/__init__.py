"""Signals in, beliefs out: front ends, smoothers, observers and their scores; all pure."""

# What is public is listed in __init__.pyi, and imported when it is first asked for.
import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
