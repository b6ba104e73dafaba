"""What stands between base and human: nothing but a handle, or a load that both carry."""

from __future__ import annotations

from ..basics.frames import Vector
from ..engine.engine import engine
from ..robot.coupling import CouplingParameters
from .chains import Base, Slab
from .hands import Wrench


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
