"""What moves and what is measured: plants, the force sensor and the PettingZoo environment."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .env.env import CowalkEnv, parallel_env

__all__ = ["CowalkEnv", "parallel_env"]


def __getattr__(name: str) -> Any:
    # PettingZoo is imported by those who use the environment, not by those who use an arc.
    if name in __all__:
        from .env import env

        return getattr(env, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
