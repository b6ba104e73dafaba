"""What stands between base and human: nothing but a handle, or a load that both carry."""

from __future__ import annotations

from dataclasses import dataclass

from .bullet_bodies import Base, Slab
from .bullet_engine import engine
from .bullet_grip import Wrench
from .frames import Vector
from .outline import Outline, rectangle
from .parameters import Range, require_choices, require_effect, require_ranges
from .urdf import Rigid

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


class Load:
    """A load clamped to the base's handle. Its origin is the clamp, it reaches backwards.

    Parameters
    ----------
    parameters : CouplingParameters
    client : int
    base : Base
    handle : (x, y, z)
        Where it is clamped, base axes, m.
    rises : bool
        Whether its height is the base's: of a base that stands on a floor.
    """

    def __init__(
        self,
        parameters: CouplingParameters,
        client: int,
        base: Base,
        handle: Vector,
        rises: bool = False,
    ) -> None:
        self._client = client
        self.handle = handle
        self.slab = Slab(client, "load", parameters.load((0.0, 0.0, handle[2])), rises)
        self._clamp = engine.createConstraint(
            base.body,
            base.link,
            self.slab.body,
            self.slab.link,
            engine.JOINT_FIXED,
            (0.0, 0.0, 0.0),
            base.pivot(handle),
            self.slab.pivot((0.0, 0.0, handle[2])),
            physicsClientId=client,
        )

    def read(self, cos: float, sin: float) -> Wrench:
        """Return the load's wrench on the base about the clamp, in base axes (see `Hands.read`)."""
        fx, fy, fz, mx, my, mz = engine.getConstraintState(self._clamp, self._client)
        return (
            cos * fx + sin * fy,
            cos * fy - sin * fx,
            fz,
            cos * mx + sin * my,
            cos * my - sin * mx,
            mz,
        )
