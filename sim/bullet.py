"""The PyBullet plant: base and human as rigid bodies, the force read from the grip between them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .bullet_engine import connect, disconnect, engine, force_on_parent, load_driven
from .bullet_view import Viewer
from .bullet_world import EngineClearance
from .drive import DriveParameters, SlipDrive
from .errors import InputError, SimulationError
from .motion import Array
from .plant import BASE_RADIUS, HUMAN_PLACE, HUMAN_RADIUS, PlantState, Rates
from .walker import Arm, Walker, WalkerParameters
from .world import World

BASE_JOINTS = ("x", "y", "yaw")
HUMAN_JOINTS = ("x", "y", "yaw", "shoulder", "elbow")
MAX_HELD = 3
"""Physics steps for which the human's joint forces are held at most: muscles need no 240 Hz."""
SOLVER_ITERATIONS = 10
"""Enough for one grip: its reaction differs from that of 50 iterations by under 1e-6 N."""
MAX_SPEED = 5.0
"""Speed of a body beyond which the simulation counts as diverged, m/s (inferred)."""
MAX_RATE = 20.0
"""Turning rate of a body beyond which the simulation counts as diverged, rad/s (inferred)."""

P = TypeVar("P", DriveParameters, WalkerParameters)


def _parameters(name: str, kind: type[P], given: P | Mapping[str, float] | None) -> P:
    if not isinstance(given, Mapping):
        return given if given is not None else kind()
    known = [field.name for field in fields(kind)]
    if unknown := [key for key in given if key not in known]:
        raise InputError(f"{name}.{unknown[0]}: unknown key; known: {', '.join(known)}")
    return kind(**given)


class BulletPlant:
    """A mobile base and a walking human, hand on handle, in a PyBullet world of their own.

    Both stand on planar joints (x, y, yaw). The base is driven by `SlipDrive`, trunk and arm by
    `Walker`; a point-to-point constraint joins hand and handle, and its reaction is the force.
    Walls and obstacles are not in this world: `cowalk.sim.bullet_world` judges collisions.

    Parameters
    ----------
    rates : Rates
    drive : DriveParameters or mapping, optional
    walker : WalkerParameters or mapping, optional
    gui : bool
        Show the run in a window, at no more than real time; `reset` opens it.

    Raises
    ------
    InputError
        If a parameter is unknown; from `reset`, if the window cannot be opened.
    """

    def __init__(
        self,
        rates: Rates,
        drive: DriveParameters | Mapping[str, float] | None = None,
        walker: WalkerParameters | Mapping[str, float] | None = None,
        gui: bool = False,
    ) -> None:
        self._rates = rates
        # Whole numbers of held steps in a control step: a new intent acts at once.
        self._held = max(n for n in range(1, MAX_HELD + 1) if rates.substeps % n == 0)
        step = 1.0 / rates.physics
        drive = _parameters("drive", DriveParameters, drive)
        walker = _parameters("walker", WalkerParameters, walker)

        self._client = client = connect()
        engine.setTimeStep(step, client)
        engine.setPhysicsEngineParameter(
            numSolverIterations=SOLVER_ITERATIONS, physicsClientId=client
        )
        self._base = base = load_driven(client, "base.urdf", "handle", BASE_JOINTS)
        self._human = human = load_driven(client, "human.urdf", "hand", HUMAN_JOINTS)
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
        self._drive = SlipDrive(drive, base.mass, base.yaw_inertia, step)
        shoulder, elbow, hand = (human.origins[n] for n in ("upper_arm", "forearm", "hand"))
        arm = Arm((shoulder[0], shoulder[1]), elbow[0] - shoulder[0], hand[0] - elbow[0])
        handle = base.origins["handle"]
        self._walker = Walker(
            walker, arm, HUMAN_PLACE, (handle[0], handle[1]), human.mass, step * self._held
        )
        self._gui = gui
        self._viewer: Viewer | None = None
        self._world: World | None = None
        self._distances: EngineClearance | None = None
        self._steps = 0
        self._base_state: tuple[float, ...] = ()
        self._human_state: tuple[float, ...] = ()

    def reset(self, world: World, rng: np.random.Generator) -> PlantState:
        """See `Plant.reset`."""
        self._world = world
        self._steps = 0
        x, y, yaw = world.start
        cos, sin = math.cos(yaw), math.sin(yaw)
        place_x, place_y, place_yaw = HUMAN_PLACE
        base = (x, y, yaw)
        human = (
            x + cos * place_x - sin * place_y,
            y + sin * place_x + cos * place_y,
            yaw + place_yaw,
            *self._walker.posture,
        )
        for body, angles in ((self._base, base), (self._human, human)):
            for joint, angle in zip(body.joints, angles, strict=True):
                engine.resetJointState(body.body, joint, angle, 0.0, self._client)
        self._base_state = base + (0.0,) * len(base)
        self._human_state = human + (0.0,) * len(human)
        self._drive.reset()
        self._walker.reset()
        self._watch()
        return self._state(np.zeros((self._rates.samples, 2)))

    def step(
        self, twist_command: tuple[float, float], hand_force: tuple[float, float]
    ) -> PlantState:
        """See `Plant.step`."""
        push = (float(hand_force[0]), float(hand_force[1]))
        speed, rate = float(twist_command[0]), float(twist_command[1])
        for name, pair in (("twist_command", (speed, rate)), ("hand_force", push)):
            if not (math.isfinite(pair[0]) and math.isfinite(pair[1])):
                raise SimulationError(f"{name} = {pair} is not finite")
        self._drive.command(speed, rate)
        self._steps += 1

        # This loop is the cost of a run: names are bound here, and engine calls take all their
        # arguments by position, which makes the joint call 1 us faster than keywords do.
        client, grip, kind = self._client, self._grip, engine.JOINT_POINT2POINT
        base_body, base_joints = self._base.body, self._base.joints
        human_body, human_joints = self._human.body, self._human.joints
        base_zeros, human_zeros = (0.0,) * len(base_joints), (0.0,) * len(human_joints)
        wrench, forces = self._drive.wrench, self._walker.forces
        apply, torque = engine.setJointMotorControlArray, engine.TORQUE_CONTROL
        advance, read, reaction = (
            engine.stepSimulation,
            engine.getJointStates,
            engine.getConstraintState,
        )
        rates, held = self._rates, self._held
        sampled, substep = rates.physics // rates.sensor, 0
        samples = []
        base, human = self._base_state, self._human_state
        _, _, yaw, vx, vy, rate = base
        cos, sin = math.cos(yaw), math.sin(yaw)
        for _ in range(rates.substeps // held):
            human_forces = forces(base, human, cos, sin, push)
            for _ in range(held):
                along, across, turn = wrench(cos * vx + sin * vy, cos * vy - sin * vx, rate)
                base_forces = (cos * along - sin * across, sin * along + cos * across, turn)
                z = base_zeros
                apply(base_body, base_joints, torque, z, z, base_forces, z, z, client)
                z = human_zeros
                apply(human_body, human_joints, torque, z, z, human_forces, z, z, client)
                advance(client)
                (x, vx, _, _), (y, vy, _, _), (yaw, rate, _, _) = read(
                    base_body, base_joints, client
                )
                cos, sin = math.cos(yaw), math.sin(yaw)
                substep += 1
                if substep % sampled == 0:
                    fx, fy, _ = force_on_parent(kind, reaction(grip, client))
                    samples.append((cos * fx + sin * fy, cos * fy - sin * fx))
            base = (x, y, yaw, vx, vy, rate)
            joints = read(human_body, human_joints, client)
            human = (*[j[0] for j in joints], *[j[1] for j in joints])
        self._base_state, self._human_state = base, human
        self._watch()
        return self._state(np.array(samples))

    def _state(self, force: Array) -> PlantState:
        x, y, yaw, vx, vy, rate = self._base_state
        human = self._human_state
        for name, velocity in (("base", (vx, vy, rate)), ("human", human[5:8])):
            # Written so that a NaN fails it.
            if not (math.hypot(*velocity[:2]) < MAX_SPEED and abs(velocity[2]) < MAX_RATE):
                raise SimulationError(
                    f"the {name} moves at ({velocity[0]:.3g}, {velocity[1]:.3g}) m/s and "
                    f"{velocity[2]:.3g} rad/s: diverged (beyond {MAX_SPEED} m/s, {MAX_RATE} rad/s)"
                )
        return PlantState(
            pose=(x, y, yaw),
            twist=(math.cos(yaw) * vx + math.sin(yaw) * vy, rate),
            human_pose=(human[0], human[1], human[2]),
            force_on_base=force,
            time=self._steps * self._rates.period,
        )

    def distances(self, world: World) -> EngineClearance:
        """See `Plant.distances`: by the engine, from the shapes of base and body."""
        if self._distances is not None:
            self._distances.close()
        self._distances = EngineClearance(world, (BASE_RADIUS, HUMAN_RADIUS))
        return self._distances

    def bare_step(self) -> None:
        """Step the engine alone, nothing driven or read: what a benchmark compares with."""
        engine.stepSimulation(self._client)

    def _view(self) -> Viewer:
        assert self._world is not None, "reset before render"
        if self._viewer is None or self._viewer.world != self._world:
            if self._viewer is not None:
                self._viewer.close()
            self._viewer = Viewer(self._world, self._gui)
        now = self._steps * self._rates.period
        self._viewer.show(self._base_state[:3], self._human_state[:5], now)
        return self._viewer

    def _watch(self) -> None:
        if self._gui:
            self._view().wait(self._rates.period)

    def render(self, width: int, height: int) -> NDArray[np.uint8]:
        """See `Plant.render`: a chase camera, rendered in software."""
        return self._view().picture(width, height)

    def close(self) -> None:
        """See `Plant.close`."""
        if self._viewer is not None:
            self._viewer.close()
        if self._distances is not None:
            self._distances.close()
        disconnect(self._client)
