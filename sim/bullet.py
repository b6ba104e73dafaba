"""The PyBullet plant: base and human as rigid bodies, the force read from the grip between them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import TypeVar

import numpy as np

from .bullet_engine import Body, connect, disconnect, engine, force_on_parent, load_driven
from .drive import DriveParameters, SlipDrive
from .errors import InputError, SimulationError
from .plant import HUMAN_PLACE, PlantState, Rates
from .walker import Arm, Walker, WalkerParameters
from .world import World

BASE_JOINTS = ("x", "y", "yaw")
HUMAN_JOINTS = ("x", "y", "yaw", "shoulder", "elbow")
MAX_SPEED = 5.0
"""Speed of a body beyond which the simulation counts as diverged, m/s (inferred)."""
MAX_RATE = 20.0
"""Turning rate of a body beyond which the simulation counts as diverged, rad/s (inferred)."""

P = TypeVar("P", DriveParameters, WalkerParameters)


def _parameters(name: str, kind: type[P], given: P | Mapping[str, float] | None) -> P:
    if isinstance(given, kind):
        return given
    try:
        return kind(**(given or {}))
    except TypeError:
        known = ", ".join(field.name for field in fields(kind))
        raise InputError(f"{name} = {given!r}: its keys must be out of {known}") from None


class BulletPlant:
    """A mobile base and a walking human, hand on handle, in a PyBullet world of their own.

    Both stand on planar joints (x, y, yaw). The base is driven by `SlipDrive`, trunk and arm by
    `Walker`; a point-to-point constraint joins hand and handle, and its reaction is the force.
    Walls and obstacles are not in this world: `cowalk.sim.world.Clearance` judges collisions.

    Parameters
    ----------
    rates : Rates
    drive : DriveParameters or mapping, optional
    walker : WalkerParameters or mapping, optional

    Raises
    ------
    InputError
        If a parameter is unknown.
    """

    def __init__(
        self,
        rates: Rates,
        drive: DriveParameters | Mapping[str, float] | None = None,
        walker: WalkerParameters | Mapping[str, float] | None = None,
    ) -> None:
        self._substeps = rates.substeps
        self._samples = rates.samples
        step = 1.0 / rates.physics
        drive = _parameters("drive", DriveParameters, drive)
        walker = _parameters("walker", WalkerParameters, walker)

        self._client = client = connect()
        engine.setTimeStep(step, client)
        self._base = base = load_driven(client, "base.urdf", "handle")
        self._human = human = load_driven(client, "human.urdf", "hand")
        self._base_joints = tuple(base.joints[name] for name in BASE_JOINTS)
        self._human_joints = tuple(human.joints[name] for name in HUMAN_JOINTS)
        self._grip = engine.createConstraint(
            base.body,
            base.grip_link,
            human.body,
            human.grip_link,
            engine.JOINT_POINT2POINT,
            (0.0, 0.0, 0.0),
            base.grip_pivot,
            human.grip_pivot,
            physicsClientId=client,
        )
        trunk = engine.getDynamicsInfo(base.body, base.joints["yaw"], client)
        self._drive = SlipDrive(drive, trunk[0], trunk[2][2], step)
        shoulder, elbow, hand = (human.origins[n] for n in ("upper_arm", "forearm", "hand"))
        self._walker = Walker(
            walker,
            Arm((shoulder[0], shoulder[1]), elbow[0] - shoulder[0], hand[0] - elbow[0]),
            HUMAN_PLACE,
            base.origins["handle"][:2],
            sum(
                engine.getDynamicsInfo(human.body, joint, client)[0]
                for joint in human.joints.values()
            ),
            step,
        )
        self._world: World | None = None

    def reset(self, world: World, rng: np.random.Generator) -> PlantState:
        """See `Plant.reset`."""
        self._world = world
        x, y, yaw = world.start
        cos, sin = math.cos(yaw), math.sin(yaw)
        place_x, place_y, place_yaw = HUMAN_PLACE
        human = (x + cos * place_x - sin * place_y, y + sin * place_x + cos * place_y)
        self._place(self._base, self._base_joints, (x, y, yaw))
        self._place(
            self._human, self._human_joints, (*human, yaw + place_yaw, *self._walker.posture)
        )
        self._drive.reset()
        self._walker.reset()
        return self._state(np.zeros((self._samples, 2)), *self._read())

    def _place(self, body: Body, joints: tuple[int, ...], angles: tuple[float, ...]) -> None:
        for joint, angle in zip(joints, angles, strict=True):
            engine.resetJointState(body.body, joint, angle, 0.0, self._client)

    def _read(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        q = engine.getJointStates
        (x, vx, _, _), (y, vy, _, _), (yaw, rate, _, _) = q(
            self._base.body, self._base_joints, self._client
        )
        a, b, c, d, e = q(self._human.body, self._human_joints, self._client)
        return (
            (x, y, yaw, vx, vy, rate),
            (a[0], b[0], c[0], d[0], e[0], a[1], b[1], c[1], d[1], e[1]),
        )

    def step(
        self, twist_command: tuple[float, float], hand_force: tuple[float, float]
    ) -> PlantState:
        """See `Plant.step`."""
        push = (float(hand_force[0]), float(hand_force[1]))
        v, omega = float(twist_command[0]), float(twist_command[1])
        for name, pair in (("twist_command", (v, omega)), ("hand_force", push)):
            if not (math.isfinite(pair[0]) and math.isfinite(pair[1])):
                raise SimulationError(f"{name} = {pair} is not finite")
        self._drive.command(v, omega)

        client, grip = self._client, self._grip
        base_body, base_joints = self._base.body, self._base_joints
        human_body, human_joints = self._human.body, self._human_joints
        wrench, forces, read = self._drive.wrench, self._walker.forces, self._read
        apply, torque = engine.setJointMotorControlArray, engine.TORQUE_CONTROL
        advance, reaction = engine.stepSimulation, engine.getConstraintState
        kind = engine.JOINT_POINT2POINT
        every = self._substeps // self._samples
        samples = []
        base, human = read()
        cos, sin = math.cos(base[2]), math.sin(base[2])
        for substep in range(1, self._substeps + 1):
            _, _, _, vx, vy, rate = base
            along, across, turn = wrench(cos * vx + sin * vy, cos * vy - sin * vx, rate)
            apply(
                base_body,
                base_joints,
                torque,
                forces=(cos * along - sin * across, sin * along + cos * across, turn),
                physicsClientId=client,
            )
            apply(
                human_body,
                human_joints,
                torque,
                forces=forces(base, human, cos, sin, push),
                physicsClientId=client,
            )
            advance(client)
            base, human = read()
            cos, sin = math.cos(base[2]), math.sin(base[2])
            if substep % every == 0:
                fx, fy, _ = force_on_parent(kind, reaction(grip, client))
                samples.append((cos * fx + sin * fy, cos * fy - sin * fx))
        return self._state(np.array(samples), base, human)

    def _state(
        self, force: np.ndarray, base: tuple[float, ...], human: tuple[float, ...]
    ) -> PlantState:
        x, y, yaw, vx, vy, rate = base
        for name, speed_x, speed_y, turn in (
            ("base", vx, vy, rate),
            ("human", human[5], human[6], human[7]),
        ):
            # Written so that a NaN fails it.
            if not (math.hypot(speed_x, speed_y) < MAX_SPEED and abs(turn) < MAX_RATE):
                raise SimulationError(
                    f"the {name} moves at ({speed_x:.3g}, {speed_y:.3g}) m/s, {turn:.3g} rad/s: "
                    f"diverged (limits {MAX_SPEED} m/s, {MAX_RATE} rad/s)"
                )
        return PlantState(
            pose=(x, y, yaw),
            twist=(math.cos(yaw) * vx + math.sin(yaw) * vy, rate),
            human_pose=human[:3],
            force_on_base=force,
        )

    def bare_step(self) -> None:
        """Step the engine alone, nothing driven: what benchmarks compare with."""
        engine.stepSimulation(self._client)

    def close(self) -> None:
        """See `Plant.close`."""
        disconnect(self._client)
