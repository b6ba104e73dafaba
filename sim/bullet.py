"""The PyBullet plant: base and human as rigid bodies, the force read from what joins them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .anthropometry import BodyParameters
from .bullet_bodies import Base, Chain, SlipBase, State
from .bullet_coupling import CouplingParameters, Load
from .bullet_engine import connect, disconnect, engine
from .bullet_grip import Hands
from .bullet_view import Look, Viewer
from .bullet_wheels import WheelBase
from .drive import DriveParameters
from .errors import InputError, SimulationError
from .gait import Gait, GaitParameters
from .grip import GripParameters
from .human_body import human_body
from .motion import Array
from .parameters import parameters
from .plant import PlantState, Rates
from .robot import RobotParameters, robot_of
from .walker import Walker, WalkerParameters
from .world import World
from .wrench import SensorMount

MAX_HELD = 3
"""Physics steps for which the human's joint forces are held at most: muscles need no 240 Hz."""
SOLVER_ITERATIONS = 10
"""Enough for one grip: its reaction differs from that of 50 iterations by under 1e-6 N."""
MAX_SPEED = 5.0
"""Speed of a body beyond which the simulation counts as diverged, m/s (inferred)."""
MAX_RATE = 20.0
"""Turning rate of a body beyond which the simulation counts as diverged, rad/s (inferred)."""
NO_WRENCH = (0.0, 0.0, 0.0)


class BulletPlant:
    """A mobile base and a walking human who hold on to each other, in a world of their own.

    The human's trunk, and with the drive "slip" the base too, stand on planar joints (x, y,
    yaw). Parameters may be given as their dataclass or as a mapping of its fields.
    Walls and obstacles are not in this world: `cowalk.sim.world.Clearance` judges collisions.

    Parameters
    ----------
    rates : Rates
    drive : DriveParameters
    body : BodyParameters
    walker : WalkerParameters
    gait : GaitParameters
    grip : GripParameters
    coupling : CouplingParameters
    robot : RobotParameters
    mount : SensorMount
        Where the force-torque sensor sits (`PlantState.wrench_on_sensor`).
    gui : bool
        Show the run in a window, at no more than real time; `reset` opens it.

    Raises
    ------
    InputError
        If a parameter is not right; from `reset`, if the window cannot be opened.
    """

    def __init__(
        self,
        rates: Rates,
        drive: DriveParameters | None = None,
        body: BodyParameters | None = None,
        walker: WalkerParameters | None = None,
        gait: GaitParameters | None = None,
        grip: GripParameters | None = None,
        coupling: CouplingParameters | None = None,
        robot: RobotParameters | None = None,
        mount: SensorMount | None = None,
        gui: bool = False,
    ) -> None:
        self._rates = rates
        step = 1.0 / rates.physics
        drive = parameters("drive", DriveParameters, drive)
        self._grip = grip = parameters("grip", GripParameters, grip)
        coupling = parameters("coupling", CouplingParameters, coupling)
        human_parameters = parameters("body", BodyParameters, body)
        walker = parameters("walker", WalkerParameters, walker)
        gait = parameters("gait", GaitParameters, gait)
        self._mount = parameters("mount", SensorMount, mount)
        robot = parameters("robot", RobotParameters, robot)
        held = robot_of(robot, human_parameters.hand, coupling.kind)
        self._handle = held.handle
        both = human_parameters.hand == "both"
        carried = coupling.kind == "stretcher"
        if drive.kind == "wheels" and robot.urdf is not None:
            raise InputError("drive.kind = 'wheels': only the robot that ships has wheels")

        self._client = client = connect()
        engine.setTimeStep(step, client)
        engine.setPhysicsEngineParameter(
            numSolverIterations=SOLVER_ITERATIONS,
            solverResidualThreshold=0.0,  # its default ends the iteration 0.04 N too early
            physicsClientId=client,
        )
        base_type = WheelBase if drive.kind == "wheels" else SlipBase
        self._base: Base = base_type(client, held.rigid, drive, step)
        self._load = Load(coupling, client, self._base, held.handle, both) if carried else None
        handles = self._load.handles if self._load else held.handles
        self._body = human = human_body(human_parameters, handles)
        self._human = Chain(client, human.urdf(), human.joints)
        thing = self._load.slab if self._load else self._base
        self._hands = Hands(
            grip, client, thing, self._human, human, handles, handles[0] if carried else held.handle
        )
        # Whole numbers of held steps in a control step: a new intent acts at once.
        most = 1 if self._hands.yields else MAX_HELD
        self._held = max(n for n in range(1, most + 1) if rates.substeps % n == 0)
        # What is held rides on the base: the human's place follows from its own.
        x, y, yaw = human.place
        if self._load:
            x, y = x + held.handle[0], y + held.handle[1]
        self._place = (x, y, yaw)
        period = step * self._held
        self._gait = Gait(gait, period)
        self._walker = Walker(walker, human, self._place, self._gait, self._human.mass, period)
        self._look = Look(held.urdf, human, coupling if self._load else None, held.handle)
        self._gui = gui
        self._viewer: Viewer | None = None
        self._world: World | None = None
        self._base_state: State = ()
        self._human_state: State = ()

    def reset(self, world: World, rng: np.random.Generator) -> PlantState:
        """See `Plant.reset`."""
        self._world = world
        x, y, yaw = world.start
        cos, sin = math.cos(yaw), math.sin(yaw)

        def beside(place: tuple[float, float, float]) -> State:
            right, up, turn = place
            return x + cos * right - sin * up, y + sin * right + cos * up, yaw + turn

        base, human = (x, y, yaw), (*beside(self._place), *self._body.posture)
        self._base.reset()
        self._hands.reset()
        self._walker.reset()
        self._gait.reset(rng)
        load: State = ()
        if self._load:
            load = (*beside((*self._load.handle[:2], 0.0)), 0.0, 0.0, 0.0)
        self._put(base + (0.0,) * 3, human + (0.0,) * len(human), load)
        self._stopped = False
        self._watch()
        return self._state(np.zeros((self._rates.samples, 6)))

    def _put(self, base: State, human: State, load: State) -> None:
        n = len(human) // 2
        self._base.put(base[:3], base[3:])
        self._human.put(human[:n], human[n:])
        if self._load:
            self._load.slab.put(load[:3], load[3:])
        self._base_state, self._human_state, self._load_state = base, human, load

    def save(self) -> Any:
        """Return the whole state within an episode, for `restore`: opaque, and never changed."""
        return (
            self._base_state,
            self._human_state,
            self._load_state,
            self._base.save(),
            self._hands.save(),
            self._walker.save(),
            self._stopped,
            self._world,
        )

    def restore(self, saved: Any) -> PlantState:
        """Go on from a saved state of this plant, or one built alike, bit for bit.

        Returns
        -------
        PlantState
            The state there; its force samples are zero, for none has been taken yet.
        """
        base, human, load, drive, hands, walker, self._stopped, self._world = saved
        self._put(base, human, load)
        self._base.restore(drive)
        self._hands.restore(hands)
        self._walker.restore(walker)
        return self._state(np.zeros((self._rates.samples, 6)))

    def step(
        self, twist_command: tuple[float, float], hand_force: tuple[float, float]
    ) -> PlantState:
        """See `Plant.step`."""
        push = (float(hand_force[0]), float(hand_force[1]))
        speed, rate = float(twist_command[0]), float(twist_command[1])
        for name, pair in (("twist_command", (speed, rate)), ("hand_force", push)):
            if not (math.isfinite(pair[0]) and math.isfinite(pair[1])):
                raise SimulationError(f"{name} = {pair} is not finite")
        if self._stopped:
            speed = rate = 0.0
        self._base.command(speed, rate)
        hands, load = self._hands, self._load
        if not hands.held:
            push = (0.0, 0.0)  # there is nothing to push

        # This loop is the cost of a run: names are bound here.
        client, advance = self._client, engine.stepSimulation
        drive, read = self._base.drive, self._base.read
        apply, read_human = self._human.apply, self._human.read
        forces, acts = self._walker.forces, hands.acts
        measure = load.read if load else hands.read
        check = load is not None and self._grip.release_force is not None
        rates, held = self._rates, self._held
        sampled, substep = rates.physics // rates.sensor, 0
        samples = []
        base, human = self._base_state, self._human_state
        cos, sin = math.cos(base[2]), math.sin(base[2])
        extra = on_load = NO_WRENCH
        for _ in range(rates.substeps // held):
            human_forces = forces(base, human, cos, sin, push)
            if acts:
                if load:
                    on_load = hands.act(load.slab.read(), human, human_forces)
                else:
                    extra = hands.act(base, human, human_forces)
            for _ in range(held):
                drive(base, cos, sin, extra)
                apply(human_forces)
                if load and acts:
                    load.slab.apply(on_load)
                advance(client)
                base = read()
                cos, sin = math.cos(base[2]), math.sin(base[2])
                substep += 1
                if substep % sampled == 0:
                    samples.append(measure(cos, sin))
                    if check:
                        hands.read(cos, sin)
            human = read_human()
        self._base_state, self._human_state = base, human
        if load:
            self._load_state = load.slab.read()
        if not hands.held and self._grip.on_loss == "stop":
            self._stopped = True
        self._watch()
        return self._state(np.array(samples))

    def _state(self, wrench: Array) -> PlantState:
        x, y, yaw, vx, vy, rate = self._base_state
        human, n = self._human_state, len(self._human_state) // 2
        bodies = [("base", (vx, vy, rate)), ("human", human[n : n + 3])]
        if self._load:
            bodies.append(("load", self._load_state[3:]))
        for name, velocity in bodies:
            # Written so that a NaN fails it.
            if not (math.hypot(*velocity[:2]) < MAX_SPEED and abs(velocity[2]) < MAX_RATE):
                raise SimulationError(
                    f"the {name} moves at ({velocity[0]:.3g}, {velocity[1]:.3g}) m/s and "
                    f"{velocity[2]:.3g} rad/s: diverged (beyond {MAX_SPEED} m/s, {MAX_RATE} rad/s)"
                )
        lost = not self._hands.held
        return PlantState(
            pose=(x, y, yaw),
            twist=(math.cos(yaw) * vx + math.sin(yaw) * vy, rate),
            human_pose=(human[0], human[1], human[2]),
            force_on_base=wrench[:, :2],
            wrench_on_base=wrench,
            mount=self._mount,
            grip_held=not lost,
            over=lost and self._grip.on_loss == "end",
        )

    def bare_step(self) -> None:
        """Step the engine alone, nothing driven or read: what a benchmark compares with."""
        engine.stepSimulation(self._client)

    @property
    def handle(self) -> tuple[float, float, float]:
        """Where the handle is, base axes, m."""
        return self._handle

    def viewer(self) -> Viewer:
        """Return what shows this plant, posed as it is now."""
        return self._view()

    def _view(self) -> Viewer:
        assert self._world is not None, "reset before render"
        if self._viewer is None or self._viewer.world != self._world:
            if self._viewer is not None:
                self._viewer.close()
            self._viewer = Viewer(self._world, self._look, self._gui)
        n = len(self._human_state) // 2
        phase = self._gait.phase if self._gait.enabled else None
        x, y, yaw, vx, vy, _ = self._base_state
        speed = math.cos(yaw) * vx + math.sin(yaw) * vy
        self._viewer.show((x, y, yaw), self._human_state[:n], self._load_state[:3], phase, speed)
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
        disconnect(self._client)
