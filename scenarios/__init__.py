"""What happens and what must hold: scenario files, runs, expectations and their figures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .files.loading import load
    from .running.build import make_env
    from .running.runner import run

__all__ = ["load", "make_env", "run"]


def __getattr__(name: str) -> Any:
    # The command line answers --help at once, because nothing is imported before it is needed.
    if name == "load":
        from .files.loading import load

        return load
    if name in __all__:
        from .running import runner

        return getattr(runner, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
