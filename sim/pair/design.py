"""Which two bodies there are, where each is held, and what they occupy. Pure."""

from __future__ import annotations

from dataclasses import dataclass

from ..basics.frames import Vector
from ..basics.validators import refusal
from ..body.anthropometry import BodyParameters
from ..body.grip import GripParameters
from ..body.human_body import HumanBody, arm_outlines, eye, human_body, trunk_outline
from ..body.walker import WalkerParameters
from ..robot.coupling import CouplingParameters, load_outline
from ..robot.drive import DriveParameters
from ..robot.overlap import refuse_overlap
from ..robot.robot import Robot, RobotParameters, robot_of, two_hands
from ..urdf.rigid import Rigid
from ..world.outline import Bodies
from .gains import Gains, refuse_unstable
from .stability import Masses


@dataclass(frozen=True)
class PairParameters:
    """Everything that decides which bodies there are."""

    drive: DriveParameters
    body: BodyParameters
    grip: GripParameters
    coupling: CouplingParameters
    robot: RobotParameters
    walker: WalkerParameters = WalkerParameters()


@dataclass(frozen=True)
class PairDesign:
    """Base, human and what is between them.

    Attributes
    ----------
    robot : Robot
    human : HumanBody
    load : Rigid or None
        Clamped to the base; its centre in base axes.
    handles : tuple of (x, y, z)
        Where each hand holds, in the axes of what is held, m.
    place : (x, y, theta)
        Where the trunk walks, base axes: m, m, rad.
    bodies : Bodies
    """

    robot: Robot
    human: HumanBody
    load: Rigid | None
    handles: tuple[Vector, ...]
    place: tuple[float, float, float]
    bodies: Bodies

    @property
    def handle(self) -> Vector:
        """Where the force on the base is measured, base axes, m."""
        return self.robot.handle


def design(parameters: PairParameters, step: float, held: int) -> PairDesign:
    """Return the bodies of a pair.

    Parameters
    ----------
    parameters : PairParameters
    step : float
        Physics step in s.
    held : int
        Physics steps for which the human's forces are held.

    Raises
    ------
    InputError
        If the robot cannot be had, or the human cannot hold it or would stand inside it, or
        gains are too high.
    """
    drive, coupling, hand = parameters.drive, parameters.coupling, parameters.body.hand
    if drive.kind == "wheels" and parameters.robot.urdf is not None:
        raise refusal(("drive", "kind"), drive.kind, "only the robot that ships has wheels")
    robot = robot_of(parameters.robot, hand, coupling.kind)
    carried = coupling.kind == "stretcher"
    handles = robot.handles
    if carried:
        end = (-coupling.length, 0.0, robot.handle[2])
        handles = two_hands(end) if hand == "both" else (end,)
    human = human_body(parameters.body, handles)
    # What is held rides on the base: the human's place follows from its own.
    x, y, yaw = human.place
    shift = robot.handle[:2] if carried else (0.0, 0.0)
    place = (x + shift[0], y + shift[1], yaw)
    refuse_overlap(parameters.body, place, robot.solids, robot.handle, parameters.robot.handle)

    load = coupling.load(robot.handle) if carried else None
    moved = Masses(robot.rigid, load, human, place, drive)
    refuse_unstable(moved, Gains(parameters.walker, parameters.grip), step, held)
    outlines = {"base": robot.outline, "human": trunk_outline(parameters.body)}
    if carried:
        outlines["load"] = load_outline(coupling, robot.handle[2])
    seats = {"automation": robot.camera, "human": eye(parameters.body)}
    bodies = Bodies(outlines, seats, arm_outlines(human, handles))
    return PairDesign(robot, human, load, handles, place, bodies)
