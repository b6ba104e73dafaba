"""A base that stands on wheels with friction, for those who want contacts and bear their noise."""

from __future__ import annotations

import math
from typing import Any

from ..basics.errors import InputError
from ..basics.frames import GRAVITY, Vector
from ..engine.engine import WorldState, engine, load
from ..robot.drive import Command, DriveParameters
from ..robot.wheels import wheel_speeds
from ..urdf.rigid import Rigid
from .chains import State, free_body

WHEEL_MASS, WHEEL_WIDTH = 1.5, 0.04
"""Of a driven wheel, kg and m (inferred)."""
CASTER_RADIUS, CASTER_AHEAD = 0.05, 0.20
"""The casters are frictionless balls ahead of and behind the axle, m (inferred)."""
BODY_SHARE = 0.1
"""Of the base's moment of inertia about the vertical, what its body has at least (inferred)."""

_LINK = (
    '<link name="{name}"><inertial><mass value="{mass!r}"/>'
    '<inertia ixx="{across!r}" iyy="{spin!r}" izz="{across!r}" ixy="0" ixz="0" iyz="0"/>'
    "</inertial><collision>{shape}</collision></link>"
)


def refuse_wide_track(rigid: Rigid, parameters: DriveParameters) -> None:
    """Refuse wheels so far apart that their moment of inertia leaves too little for the body.

    Raises
    ------
    InputError
        With the widest track that does.
    """
    track = parameters.wheel_track
    share = (1.0 - BODY_SHARE) * rigid.yaw_inertia - 2.0 * _across(parameters)
    widest = math.floor(100.0 * math.sqrt(2.0 * share / WHEEL_MASS)) / 100.0
    if track > widest:
        raise InputError(
            f"drive.wheel_track = {track} m: wheels of {WHEEL_MASS} kg so far apart take more than "
            f"{1.0 - BODY_SHARE:.0%} of the base's {rigid.yaw_inertia:.3g} kg m^2; must be "
            f"{widest:g} m or less with wheel_radius = {parameters.wheel_radius:g} m",
            ("drive", "wheel_track"),
        )


def _across(parameters: DriveParameters) -> float:
    """Return a wheel's moment of inertia across its axle, about its own centre, kg m^2."""
    return WHEEL_MASS * (3.0 * parameters.wheel_radius**2 + WHEEL_WIDTH**2) / 12.0


def wheels_urdf(rigid: Rigid, parameters: DriveParameters) -> str:
    """Return the base on two wheels and two casters; what the wheels weigh is the body's share."""
    radius, half = parameters.wheel_radius, parameters.wheel_track / 2.0
    spin = WHEEL_MASS * radius**2 / 2.0
    across = _across(parameters)
    mass = rigid.mass - 2.0 * WHEEL_MASS
    yaw = rigid.yaw_inertia - 2.0 * WHEEL_MASS * half**2 - 2.0 * across
    x, y, z = rigid.centre
    balls = "".join(
        f'<collision><origin xyz="{ahead!r} 0 {CASTER_RADIUS!r}"/><geometry>'
        f'<sphere radius="{CASTER_RADIUS!r}"/></geometry></collision>'
        for ahead in (CASTER_AHEAD, -CASTER_AHEAD)
    )
    body = (
        f'<link name="base"><inertial><origin xyz="{x!r} {y!r} {z!r}"/><mass value="{mass!r}"/>'
        f'<inertia ixx="{yaw!r}" iyy="{yaw!r}" izz="{yaw!r}" ixy="0" ixz="0" iyz="0"/></inertial>'
        f"{balls}</link>"
    )
    # A ball's contact is one point; a cylinder's flickers between the two ends of its edge.
    shape = f'<geometry><sphere radius="{radius!r}"/></geometry>'
    wheels = "".join(
        _LINK.format(name=name, mass=WHEEL_MASS, spin=spin, across=across, shape=shape)
        + f'<joint name="{name}" type="continuous"><parent link="base"/><child link="{name}"/>'
        f'<origin xyz="0 {side * half!r} {radius!r}"/><axis xyz="0 1 0"/></joint>'
        for name, side in (("left", 1.0), ("right", -1.0))
    )
    return f'<robot name="base">{body}{wheels}</robot>'


class WheelBase:
    """A base on a floor: two driven wheels with friction, two casters without.

    Parameters
    ----------
    client : int
        The engine's world; it gets gravity and a floor.
    rigid : Rigid
    parameters : DriveParameters
    step : float
        Physics step in s.
    """

    link = -1

    def __init__(self, client: int, rigid: Rigid, parameters: DriveParameters, step: float) -> None:
        self._client = client
        self._centre = rigid.centre
        self._command = Command(parameters, step)
        self._wheels = parameters.wheel_track, parameters.wheel_radius
        torque = parameters.max_force * parameters.wheel_radius / 2.0
        self._torques = (torque, torque)
        engine.setGravity(0.0, 0.0, -GRAVITY, client)
        floor = engine.createMultiBody(
            0.0,
            engine.createCollisionShape(engine.GEOM_PLANE, physicsClientId=client),
            physicsClientId=client,
        )
        engine.changeDynamics(floor, -1, lateralFriction=1.0, physicsClientId=client)
        self.body = body = load(
            client,
            wheels_urdf(rigid, parameters),
            fixed=False,
            flags=engine.URDF_USE_INERTIA_FROM_FILE,
        )
        for joint, friction in ((-1, 0.0), (0, parameters.friction), (1, parameters.friction)):
            free_body(client, body, joint)
            engine.changeDynamics(
                body,
                joint,
                lateralFriction=friction,
                rollingFriction=0.0,
                spinningFriction=0.0,
                restitution=0.0,
                physicsClientId=client,
            )
        self.command = self._command.set
        self.reset = self._command.reset
        self._turns = 0.0
        self._last = 0.0

    def pivot(self, place: Vector) -> Vector:
        """See `Base.pivot`."""
        x, y, z = self._centre
        return place[0] - x, place[1] - y, place[2] - z

    def put(self, angles: State, rates: State | None = None) -> None:
        """See `Base.put`."""
        x, y, yaw = angles
        vx, vy, rate = rates or (0.0, 0.0, 0.0)
        cos, sin = math.cos(yaw), math.sin(yaw)
        cx, cy, cz = self._centre
        turn = engine.getQuaternionFromEuler((0.0, 0.0, yaw))
        place = (x + cos * cx - sin * cy, y + sin * cx + cos * cy, cz)
        client, body = self._client, self.body
        engine.resetBasePositionAndOrientation(body, place, turn, client)
        lever = place[0] - x, place[1] - y
        engine.resetBaseVelocity(
            body, (vx - rate * lever[1], vy + rate * lever[0], 0.0), (0.0, 0.0, rate), client
        )
        forward = cos * vx + sin * vy
        for joint, speed in enumerate(wheel_speeds(forward, rate, *self._wheels)):
            engine.resetJointState(body, joint, 0.0, speed, client)
        self._turns, self._last = yaw - math.remainder(yaw, math.tau), math.remainder(yaw, math.tau)

    def drive(self, state: State, cos: float, sin: float, extra: Vector) -> None:
        """See `Base.drive`."""
        targets = wheel_speeds(*self._command.advance(), *self._wheels)
        client, body = self._client, self.body
        engine.setJointMotorControlArray(
            body,
            (0, 1),
            engine.VELOCITY_CONTROL,
            targetVelocities=targets,
            forces=self._torques,
            physicsClientId=client,
        )
        fx, fy, torque = extra
        if fx or fy or torque:
            x, y, _ = engine.getBasePositionAndOrientation(body, client)[0]
            height = self.grip_height
            engine.applyExternalForce(
                body, -1, (fx, fy, 0.0), (x, y, height), engine.WORLD_FRAME, client
            )
            # The wrench is about the base's origin, the force acts at its centre of mass.
            lever_x, lever_y = x - state[0], y - state[1]
            torque -= lever_x * fy - lever_y * fx
            engine.applyExternalTorque(body, -1, (0.0, 0.0, torque), engine.WORLD_FRAME, client)

    grip_height = 1.0
    """Where a yielding grip acts, m above the floor."""

    def read(self) -> State:
        """See `Base.read`."""
        (x, y, _), turn = engine.getBasePositionAndOrientation(self.body, self._client)
        (vx, vy, _), (_, _, rate) = engine.getBaseVelocity(self.body, self._client)
        qx, qy, qz, qw = turn
        yaw = math.atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz))
        # The yaw goes on beyond half a turn, as that of a joint does.
        self._turns += math.tau * round((self._last - yaw) / math.tau)
        self._last = yaw
        yaw += self._turns
        cos, sin = math.cos(yaw), math.sin(yaw)
        cx, cy, _ = self._centre
        dx, dy = cos * cx - sin * cy, sin * cx + cos * cy
        return x - dx, y - dy, yaw, vx + rate * dy, vy - rate * dx, rate

    def mean_drive(self) -> tuple[float, float]:
        """See `Base.mean_drive`: what contacts pass on is not known."""
        return math.nan, math.nan

    def save(self) -> Any:
        """See `Base.save`."""
        # Contacts carry what the solver learned in the last step; only the engine can save them.
        return WorldState(self._client), self._command.save(), self._turns, self._last

    def restore(self, saved: Any) -> None:
        """See `Base.restore`."""
        snapshot, command, self._turns, self._last = saved
        snapshot.restore()
        self._command.restore(command)
