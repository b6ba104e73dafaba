"""Bodies that the physics moves: chains on planar joints, and the drives of the base.

A state is (x, y, yaw, vx, vy, rate) in world axes: m, rad, m/s, rad/s.
"""

from __future__ import annotations

import math
from typing import Any, Protocol

from ..basics.frames import Vector
from ..engine.engine import engine, load
from ..robot.drive import DriveParameters, SlipDrive, slip_gains
from ..urdf.chain import link, planar
from ..urdf.rigid import Rigid

State = tuple[float, ...]

BARE = engine.URDF_IGNORE_VISUAL_SHAPES | engine.URDF_USE_INERTIA_FROM_FILE
"""Without the second flag the engine makes up inertias from the (absent) collision shapes."""

_SET_JOINTS, _GET_JOINTS = engine.setJointMotorControlArray, engine.getJointStates
_TORQUE = engine.TORQUE_CONTROL


class Chain:
    """A body on planar joints: nothing but the forces given to it act on its joints.

    Fixed links are left out of it, for every link costs time, and the engine's own
    URDF_MERGE_FIXED_LINKS moves the parent's centre of mass (bulletphysics/bullet3#4683).

    Parameters
    ----------
    client : int
    urdf : str
        With a held root link and no fixed joints.
    joints : tuple of str
        Names of the joints of a state, in its order; others move as they are moved.
    """

    def __init__(self, client: int, urdf: str, joints: tuple[str, ...]) -> None:
        self.client = client
        self.body = body = load(client, urdf, flags=BARE)
        count = engine.getNumJoints(body, client)
        info = [engine.getJointInfo(body, joint, client) for joint in range(count)]
        index = {i[1].decode(): joint for joint, i in enumerate(info)}
        self.links = {i[12].decode(): joint for joint, i in enumerate(info)}
        """Index of every link by name."""
        self.joints = tuple(index[name] for name in joints)
        self._passive = tuple(j for name, j in index.items() if name not in joints)
        self.zeros = (0.0,) * len(joints)
        free_body(client, body, -1)
        for joint in range(count):
            free_body(client, body, joint)
            engine.setCollisionFilterGroupMask(body, joint, 0, 0, client)
        dynamics = [engine.getDynamicsInfo(body, joint, client) for joint in range(count)]
        self.mass = sum(d[0] for d in dynamics)

    def put(self, angles: State, rates: State | None = None) -> None:
        """Set joint positions and rates (at rest without them)."""
        for joint, angle, rate in zip(self.joints, angles, rates or self.zeros, strict=True):
            engine.resetJointState(self.body, joint, angle, rate, self.client)
        for joint in self._passive:
            engine.resetJointState(self.body, joint, 0.0, 0.0, self.client)

    def apply(self, forces: Any) -> None:
        """Apply joint forces in the next physics step, N and N m."""
        zeros = self.zeros
        # By position: keywords make this call 1 us slower.
        _SET_JOINTS(
            self.body,
            self.joints,
            _TORQUE,
            zeros,
            zeros,
            forces,
            zeros,
            zeros,
            self.client,
        )

    def read(self) -> State:
        """Return joint positions, then rates."""
        states = _GET_JOINTS(self.body, self.joints, self.client)
        return (*[s[0] for s in states], *[s[1] for s in states])


def free_body(client: int, body: int, joint: int) -> None:
    """Take the engine's damping, joint friction and default motor off a link."""
    engine.changeDynamics(
        body,
        joint,
        linearDamping=0.0,
        angularDamping=0.0,
        jointDamping=0.0,
        physicsClientId=client,
    )
    if joint >= 0:
        engine.setJointMotorControl2(
            body, joint, engine.VELOCITY_CONTROL, force=0.0, physicsClientId=client
        )


PLANE = ("x", "y", "yaw")


class Slab(Chain):
    """A single rigid body on planar joints, from what it weighs as a whole.

    Parameters
    ----------
    client : int
    name : str
    rigid : Rigid
    rises : bool
        Whether its height is free.
    """

    def __init__(self, client: int, name: str, rigid: Rigid, rises: bool = False) -> None:
        part = link(name, rigid.mass, rigid.centre, rigid.yaw_inertia)
        super().__init__(client, planar(name, name, part, rises), PLANE)
        self._centre = rigid.centre
        self.link = self.links[name]

    def pivot(self, place: Vector) -> Vector:
        """Return a place in the body's axes, from its centre of mass, m."""
        x, y, z = self._centre
        return place[0] - x, place[1] - y, place[2] - z


class Base(Protocol):
    """A driven base."""

    body: int
    link: int

    def pivot(self, place: Vector) -> Vector:
        """Return a place in the base's axes, from the centre of mass of its link, m."""
        ...

    def put(self, angles: State, rates: State | None = None) -> None:
        """Set pose and velocity."""
        ...

    def command(self, speed: float, rate: float) -> None:
        """Set the twist to approach, m/s and rad/s."""
        ...

    def drive(self, state: State, cos: float, sin: float, extra: Vector) -> None:
        """Act for one physics step, with a further wrench (N, N, N m; world axes) on it."""
        ...

    def read(self) -> State:
        """Return the state."""
        ...

    def mean_drive(self) -> tuple[float, float]:
        """Return force along the base and torque of the drive, N and N m, since last asked.

        About the origin; NaN where not known, or where nothing was driven since.
        """
        ...

    def reset(self, speed: float = 0.0, rate: float = 0.0) -> tuple[float, float]:
        """Forget the command, at a twist (m/s, rad/s), and return it as the limits leave it."""
        ...

    def save(self) -> Any:
        """Return what `restore` takes."""
        ...

    def restore(self, saved: Any) -> None:
        """Go on from a saved state of the drive; pose and velocity are set by `put`."""
        ...


class SlipBase(Slab):
    """A base on planar joints, driven by `SlipDrive`."""

    def __init__(self, client: int, rigid: Rigid, parameters: DriveParameters, step: float) -> None:
        super().__init__(client, "base", rigid)
        gains = slip_gains(parameters, rigid.mass, rigid.yaw_inertia, step)
        self._drive = SlipDrive(parameters, gains, step)
        self._wrench = self._drive.wrench
        self.command = self._drive.command.set
        self.reset = self._drive.command.reset
        self.save = self._drive.command.save
        self.restore = self._drive.command.restore
        self._force = self._torque = 0.0
        self._driven = 0

    def drive(self, state: State, cos: float, sin: float, extra: Vector) -> None:
        """See `Base.drive`."""
        _, _, _, vx, vy, rate = state
        along, across, turn = self._wrench(cos * vx + sin * vy, cos * vy - sin * vx, rate)
        self._force += along
        self._torque += turn
        self._driven += 1
        fx, fy, torque = extra
        zeros = self.zeros
        # As `apply`, written out: this is the innermost loop.
        _SET_JOINTS(
            self.body,
            self.joints,
            _TORQUE,
            zeros,
            zeros,
            (cos * along - sin * across + fx, sin * along + cos * across + fy, turn + torque),
            zeros,
            zeros,
            self.client,
        )

    def read(self) -> State:
        """See `Base.read`."""
        (x, vx, _, _), (y, vy, _, _), (yaw, rate, _, _) = _GET_JOINTS(
            self.body, self.joints, self.client
        )
        return x, y, yaw, vx, vy, rate

    def mean_drive(self) -> tuple[float, float]:
        """See `Base.mean_drive`."""
        steps = self._driven or math.nan
        mean = self._force / steps, self._torque / steps
        self._force = self._torque = 0.0
        self._driven = 0
        return mean
