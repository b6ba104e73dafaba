"""What both agents know before they start."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from .lists import require_entries
from .motion import BOUND
from .path import Path
from .rates import Rates
from .validators import Range, is_array, is_number, lies, require, require_instance, require_ranges

RANGES: dict[str, Range] = {"pace": (0.01, 5.0, "m/s"), "period": (1e-6, 10.0, "s")}
"""What people walk at, and in what steps (inferred)."""
REACH: Range = (0.0, 20.0, "m")
"""Of what two people walk with, m (inferred)."""
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

    Raises
    ------
    InputError
        If a part is of the wrong kind, a number outside of `RANGES` or `REACH`, or a bound
        outside of `cowalk.sim.basics.motion.BOUND`.
    """

    path: Path
    pace: float
    bounds: Bounds
    period: float
    extent: tuple[float, float, float] = SIDE_BY_SIDE
    rates: Rates = Rates()

    def __post_init__(self) -> None:
        require_instance("path", self.path, Path)
        for name in ("lower", "upper"):
            bound = getattr(self.bounds, name, None)
            if isinstance(bound, tuple | list) and all(map(is_number, bound)):
                bound = np.array(bound)
            right = is_array(bound) and bound.shape[-1:] == (2,) and lies(bound, BOUND)
            require(right, "bounds", self.bounds, "lower and upper bounds of a twist are expected")
        require_ranges(self, RANGES)
        require_entries(self, ("extent",), 3, REACH)
        require_instance("rates", self.rates, Rates)
