"""What human and base hold between them: a handle, or a load they carry."""

from __future__ import annotations

from dataclasses import dataclass

from ..basics.frames import Vector
from ..basics.validators import Range, require_choices, require_effect, require_ranges
from ..urdf.rigid import Rigid
from ..world.outline import Outline, rectangle

COUPLINGS = ("handle", "stretcher")

RANGES: dict[str, Range] = {
    "mass": (0.5, 150.0, "kg"),
    "length": (0.3, 4.0, "m"),
    "width": (0.05, 2.0, "m"),
}
"""What two can carry (inferred)."""

THICKNESS = 0.02
"""Of a load, m."""


@dataclass(frozen=True)
class CouplingParameters:
    """How the two are joined.

    Parameters
    ----------
    kind : {"handle", "stretcher"}
        The human holds the base's handle; or a load between the two is clamped to the base at
        one end and held by the human at the other. The measured wrench is that on the base.
    mass, length, width : float
        Of the load, kg and m (inferred: an empty stretcher).

    Raises
    ------
    InputError
        If the kind is unknown, a number is outside of `RANGES`, or one is given though there is
        no load.
    """

    kind: str = "handle"
    mass: float = 8.0
    length: float = 1.2
    width: float = 0.5

    def __post_init__(self) -> None:
        require_choices(self, {"kind": COUPLINGS})
        require_ranges(self, RANGES)
        require_effect(self, {"stretcher": RANGES})

    def load(self, clamp: Vector) -> Rigid:
        """Return the load in the axes in which its clamp is at a place, m; it reaches backwards."""
        x, y, z = clamp
        inertia = self.mass * (self.length**2 + self.width**2) / 12.0
        return Rigid(self.mass, (x - self.length / 2.0, y, z), inertia, {})


def load_outline(parameters: CouplingParameters, height: float) -> Outline:
    """Return what a load clamped at a height (m) occupies: its origin is the clamp."""
    half = parameters.width / 2.0
    return rectangle(-parameters.length, 0.0, -half, half, underside=height - THICKNESS / 2.0)
