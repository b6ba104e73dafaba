"""What the bodies look like."""

from __future__ import annotations

from dataclasses import dataclass

from ..basics.frames import Vector
from ..body.human_body import HumanBody
from ..robot.coupling import CouplingParameters


@dataclass(frozen=True)
class Look:
    """What the bodies look like.

    Attributes
    ----------
    robot : str
        URDF of the base.
    human : HumanBody
    load : CouplingParameters or None
        What they carry.
    clamp : (x, y, z)
        Where the load is clamped, base axes, m.
    """

    robot: str
    human: HumanBody
    load: CouplingParameters | None
    clamp: Vector
