"""Signals in, beliefs out: intent, stubbornness, smoothing and their scores; all pure."""
