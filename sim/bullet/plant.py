"""The PyBullet plant: base and human as rigid bodies, the force read from what joins them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NoReturn
from weakref import WeakSet

import numpy as np
from numpy.typing import NDArray

from ..basics.errors import InputError, SimulationError
from ..basics.motion import Array
from ..basics.parameters import parameters
from ..basics.rates import Rates
from ..basics.validators import require_flag, require_instance
from ..body.anthropometry import BodyParameters
from ..body.gait import Gait, GaitParameters
from ..body.grip import GripParameters
from ..body.walker import Walker, WalkerParameters
from ..engine.engine import engine
from ..pair.design import PairParameters
from ..plant.protocol import PlantState
from ..robot.coupling import CouplingParameters
from ..robot.drive import DriveParameters
from ..robot.robot import RobotParameters
from ..sensor.wrench import SensorMount
from ..world.outline import Bodies
from ..world.world import World
from .distances import EngineClearance
from .pair import Pair
from .pictures import Pictures
from .report import report
from .start import set_off

if TYPE_CHECKING:
    from ..view.viewer import Viewer

MAX_HELD = 3
"""Physics steps for which the human's joint forces are held at most: muscles need no 240 Hz."""
NO_WRENCH = (0.0, 0.0, 0.0)


class BulletPlant:
    """A mobile base and a walking human who hold on to each other, in a world of their own.

    The human's trunk, and with the drive "slip" the base too, stand on planar joints (x, y,
    yaw). Parameters may be given as their dataclass or as a mapping of its fields.
    Walls and obstacles are not in this world: `cowalk.sim.bullet.distances` judges collisions.

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
        Where the force-torque sensor sits: the frame in which it reads.
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
        drive: DriveParameters = DriveParameters(),
        body: BodyParameters = BodyParameters(),
        walker: WalkerParameters = WalkerParameters(),
        gait: GaitParameters = GaitParameters(),
        grip: GripParameters = GripParameters(),
        coupling: CouplingParameters = CouplingParameters(),
        robot: RobotParameters = RobotParameters(),
        mount: SensorMount = SensorMount(),
        gui: bool = False,
    ) -> None:
        require_flag("gui", gui)
        require_instance("rates", rates, Rates)
        self._rates = rates
        step = 1.0 / rates.physics
        walker = parameters("walker", WalkerParameters, walker)
        gait = parameters("gait", GaitParameters, gait)
        drive = parameters("drive", DriveParameters, drive)
        self.wheels = drive.wheel_track, drive.wheel_radius
        """See `Plant.wheels`."""
        self._grip = parameters("grip", GripParameters, grip)
        self._mount = parameters("mount", SensorMount, mount)
        # Whole numbers of held steps in a control step: a new intent acts at once.
        most = 1 if self._grip.kind == "compliant" else MAX_HELD
        self._held = max(n for n in range(1, most + 1) if rates.substeps % n == 0)
        self._pair = pair = Pair(
            PairParameters(
                drive,
                parameters("body", BodyParameters, body),
                self._grip,
                parameters("coupling", CouplingParameters, coupling),
                parameters("robot", RobotParameters, robot),
                walker,
            ),
            step,
            self._held,
        )
        period = step * self._held
        self._gait = Gait(gait, period)
        self._walker = Walker(walker, pair.body, pair.place, self._gait, pair.human.mass, period)
        self._gui = gui
        self._pictures = Pictures(gui)
        self._world: World | None = None
        self._distances: WeakSet[EngineClearance] = WeakSet()  # who drops one frees it
        self._steps = 0

    def reset(
        self, world: World, rng: np.random.Generator, twist: tuple[float, float] = (0.0, 0.0)
    ) -> PlantState:
        """See `Plant.reset`."""
        self._world = world
        self._steps = 0
        self._stopped = False
        step = 1.0 / self._rates.physics
        standing = set_off(self._pair, self._walker, world.start, twist, rng, step)
        self._watch()
        return self._state(np.tile(standing, (self._rates.samples, 1)))

    def save(self) -> Any:
        """See `Plant.save`."""
        return self._pair.save(), self._walker.save(), self._stopped, self._world, self._steps

    def restore(self, saved: Any) -> PlantState:
        """See `Plant.restore`: into this plant, or with the drive "slip" into one built alike."""
        pair, walker, self._stopped, self._world, self._steps = saved
        self._pair.restore(pair)
        self._walker.restore(walker)
        return self._state(np.zeros((self._rates.samples, 6)))

    def __reduce__(self) -> NoReturn:
        """Refuse to be copied or pickled: the engine's world would be shared.

        Raises
        ------
        InputError
            Always.
        """
        raise InputError(
            "a plant in PyBullet cannot be copied or pickled: copy the environment that holds it, "
            "or build another one and hand it what save gives"
        )

    def step(
        self, twist_command: tuple[float, float], hand_force: tuple[float, float]
    ) -> PlantState:
        """See `Plant.step`."""
        push = (float(hand_force[0]), float(hand_force[1]))
        speed, rate = float(twist_command[0]), float(twist_command[1])
        for name, given in (("twist_command", (speed, rate)), ("hand_force", push)):
            if not (math.isfinite(given[0]) and math.isfinite(given[1])):
                raise SimulationError(f"{name} = {given} is not finite")
        self._steps += 1
        if self._stopped:
            speed = rate = 0.0
        pair = self._pair
        hands, load = pair.hands, pair.load
        pair.base.command(speed, rate)
        if not hands.held:
            push = (0.0, 0.0)  # there is nothing to push

        # This loop is the cost of a run: names are bound here.
        client, advance = pair.client, engine.stepSimulation
        drive, read = pair.base.drive, pair.base.read
        apply, read_human = pair.human.apply, pair.human.read
        forces, acts = self._walker.forces, hands.acts
        measure = load.read if load else hands.read
        check = self._grip.release_force is not None
        rates, held = self._rates, self._held
        sampled, substep = rates.physics // rates.sensor, 0
        samples: list[float] = []
        work, (hand_x, hand_y, _) = 0.0, pair.handle
        base, human = pair.base_state, pair.human_state
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
                _, _, _, vx, vy, rate = base
                base = read()
                cos, sin = math.cos(base[2]), math.sin(base[2])
                substep += 1
                wrench = measure(cos, sin)
                if substep % sampled == 0:
                    samples += wrench
                # A force held through a step does its work at the mean of the two velocities.
                vx, vy, rate = vx + base[3], vy + base[4], rate + base[5]
                along, across = cos * vx + sin * vy, cos * vy - sin * vx
                work += wrench[0] * (along - rate * hand_y)
                work += wrench[1] * (across + rate * hand_x) + wrench[5] * rate
                if check and load:
                    hands.read(cos, sin)  # which lets go
            human = read_human()
        pair.base_state, pair.human_state = base, human
        if load:
            pair.load_state = load.slab.read()
        if not hands.held and self._grip.on_loss == "stop":
            self._stopped = True
        self._watch()
        # Reshaping is twice as fast as an array from rows.
        return self._state(np.array(samples).reshape(-1, 6), 0.5 * work / rates.physics)

    def _state(self, wrench: Array, work: float = 0.0) -> PlantState:
        time = self._steps * self._rates.period
        ends = self._grip.on_loss == "end"
        return report(self._pair, self._walker, ends, self._mount, wrench, work, time)

    def distances(self, world: World) -> EngineClearance:
        """See `Plant.distances`: by the engine."""
        distances = EngineClearance(world, self.bodies.parts)
        self._distances.add(distances)
        return distances

    def bare_step(self) -> None:
        """Step the engine alone, nothing driven or read: what a benchmark compares with."""
        engine.stepSimulation(self._pair.client)

    @property
    def steers_from_behind(self) -> bool:
        """See `Plant.steers_from_behind`: the stretcher is held at its tail."""
        return self._pair.load is not None

    @property
    def bodies(self) -> Bodies:
        """See `Plant.bodies`: as robot, human and load are built."""
        return self._pair.bodies

    @property
    def handle(self) -> tuple[float, float, float]:
        """Where the handle is, base axes, m."""
        return self._pair.look.clamp

    def viewer(self) -> Viewer:
        """Return what shows this plant, posed as it is now."""
        assert self._world is not None, "reset before render"
        phase = self._gait.phase if self._gait.enabled else None
        return self._pictures.of(self._world, self._pair, phase, self._steps * self._rates.period)

    def _watch(self) -> None:
        if self._gui:
            self.viewer().wait(self._rates.period)

    def render(self, width: int, height: int) -> NDArray[np.uint8]:
        """See `Plant.render`: a chase camera, rendered in software."""
        return self.viewer().picture(width, height)

    def close(self) -> None:
        """See `Plant.close`."""
        self._pictures.close()
        for distances in tuple(self._distances):
            distances.close()
        self._pair.close()
