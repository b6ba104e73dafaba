"""What both agents know before they start."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from numpy.typing import ArrayLike

from .path import Path
from .rates import Rates

SIDE_BY_SIDE = (0.28, 0.87, 0.32)
"""Extent of a human to the right of the base that ships, the left hand on its handle, m."""


class Bounds(Protocol):
    """Bounds of a twist: a `TwistBounds`, or arrays of shape (..., 2) for a batch."""

    @property
    def lower(self) -> ArrayLike:
        """Lower bounds ``[v, omega]``, m/s and rad/s."""

    @property
    def upper(self) -> ArrayLike:
        """Upper bounds ``[v, omega]``, m/s and rad/s."""


@dataclass(frozen=True)
class Situation:
    """What both agents know before they start.

    Attributes
    ----------
    path : Path
        Global path, world axes.
    pace : float
        Usual walking speed, m/s.
    bounds : Bounds
        Bounds of the twist that either may wish for.
    period : float
        Control period, s.
    extent : (left, right, behind)
        How far base, human and what they carry reach from the base's centre as they set out, m.
        Without it, as human and base do side by side.
    rates : Rates
        Of control, physics and force sensor.
    """

    path: Path
    pace: float
    bounds: Bounds
    period: float
    extent: tuple[float, float, float] = SIDE_BY_SIDE
    rates: Rates = Rates()
