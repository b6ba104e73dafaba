"""The protocol of a smoother: one value a negotiation, smoothed."""

from __future__ import annotations

from typing import Protocol

from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array


class Smoother(Protocol):
    """Takes one value a negotiation and returns the smoothed one."""

    def reset(self, initial: ArrayLike) -> None:
        """Forget everything; behave as if ``initial`` had been seen for ever."""
        ...

    def update(self, value: ArrayLike) -> Array:
        """Return the smoothed value after one more sample, of the same shape."""
        ...
