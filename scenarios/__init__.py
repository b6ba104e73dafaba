"""What happens and what must hold: scenario files, runs, expectations and their figures."""

# What is public is listed in __init__.pyi, and imported when it is first asked for.
import lazy_loader

from .single_seat import registration as _registration

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

_registration.register()
