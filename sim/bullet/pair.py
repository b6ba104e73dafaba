"""Base, human, and what is between them, built in an engine world of their own."""

from __future__ import annotations

import math
from typing import Any, NoReturn

import numpy as np

from ..basics.errors import InputError, SimulationError
from ..basics.frames import Vector
from ..basics.motion import Array
from ..engine.engine import connect, engine, free_with
from ..pair.design import PairParameters, design
from ..view.look import Look
from .chains import Base, Chain, SlipBase, State
from .hands import Hands
from .load import Load
from .wheel_base import WheelBase, refuse_wide_track

SETTLING = 0.25
"""Time in which the floor takes the load's weight, s: within 0.1 % after 0.05 s."""
SOLVER_ITERATIONS = {"slip": 10, "wheels": 50}
"""By drive. Grips alone come within 0.01 N of what 200 iterations give, contacts take longer."""


class KeptByEngine:
    """Marks states that the engine of one pair keeps."""

    def __reduce__(self) -> NoReturn:
        """Refuse to be copied or pickled.

        Raises
        ------
        InputError
            Always.
        """
        raise InputError(
            "with drive.kind = 'wheels' the engine keeps the state, so an environment cannot be "
            "copied or pickled once it was reset: use save and restore in the environment itself, "
            "or make another one"
        )


MAX_SPEED = 5.0
"""Speed of a body beyond which the simulation counts as diverged, m/s (inferred)."""
MAX_RATE = 20.0
"""Turning rate of a body beyond which the simulation counts as diverged, rad/s (inferred)."""


class Pair:
    """The bodies of a plant, and their state.

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

    def __init__(self, parameters: PairParameters, step: float, held: int = 1) -> None:
        drive, coupling = parameters.drive, parameters.coupling
        made = design(parameters, step, held)
        robot, handles = made.robot, made.handles
        if drive.kind == "wheels":
            refuse_wide_track(robot.rigid, drive)
        carried = coupling.kind == "stretcher"
        self.handle: Vector = made.handle
        """Where the force on the base is measured, base axes, m."""
        self.body = made.human
        self.place = made.place
        """Where the trunk walks, base axes: m, m, rad."""
        self.bodies = made.bodies
        self.look = Look(robot.urdf, self.body, coupling if carried else None, robot.handle)

        # Nothing is refused from here on, so that no client is left behind.
        self.client = client = connect()
        self._free = free_with(self, client)
        engine.setTimeStep(step, client)
        engine.setPhysicsEngineParameter(
            numSolverIterations=SOLVER_ITERATIONS[drive.kind],
            solverResidualThreshold=0.0,  # its default ends the iteration 0.04 N too early
            useSplitImpulse=0,  # else a joint more than 0.04 rad beyond its limit stays there
            physicsClientId=client,
        )
        stands = drive.kind == "wheels"
        self._owner = KeptByEngine() if stands else None
        base = WheelBase if stands else SlipBase
        self.base: Base = base(client, robot.rigid, drive, step)
        # Heights settle on the floor's contacts; planar joints would take the weight off them.
        self.load = Load(coupling, client, self.base, robot.handle, stands) if carried else None
        # A yielding grip joins no link: a hand of its own would fall, for ever.
        hands_rise = stands and parameters.grip.kind == "rigid"
        self.human = Chain(client, self.body.urdf(hands_rise), self.body.joints)
        thing = self.load.slab if self.load else self.base
        origin = handles[0] if carried else robot.handle
        self.hands = Hands(parameters.grip, client, thing, self.human, self.body, handles, origin)
        self.base_state: State = ()
        self.human_state: State = ()
        self.load_state: State = ()

    def put(self, base: State, human: State, load: State) -> None:
        """Set every body's state: positions, then rates."""
        n = len(human) // 2
        self.base.put(base[:3], base[3:])
        self.human.put(human[:n], human[n:])
        if self.load:
            self.load.slab.put(load[:3], load[3:])
        self.base_state, self.human_state, self.load_state = base, human, load

    def standing_wrench(self, step: float) -> Array:
        """Return the wrench on the base at rest, nobody pushing: base axes, about the handle, (6,).

        On planar joints nothing has weight, and without a load none hangs on the sensor. On a
        floor the load stands on its own for `SETTLING`, at the end of which it is measured, and
        then everything is put back.
        """
        if self.load is None or self._owner is None:
            return np.zeros(6)
        saved = self.save()
        samples = []
        for _ in range(round(SETTLING / step)):
            state = self.base.read()
            cos, sin = math.cos(state[2]), math.sin(state[2])
            self.base.drive(state, cos, sin, (0.0, 0.0, 0.0))
            engine.stepSimulation(self.client)
            samples.append(self.load.read(cos, sin))
        self.restore(saved)
        return np.asarray(np.mean(samples[len(samples) // 2 :], axis=0))

    def save(self) -> Any:
        """Return what `restore` takes."""
        states = self.base_state, self.human_state, self.load_state
        return self._owner, states, self.base.save(), self.hands.save()

    def restore(self, saved: Any) -> None:
        """Go on from a saved state.

        Raises
        ------
        InputError
            If it is kept by the engine, for another pair.
        """
        owner, states, drive, hands = saved
        if owner is not self._owner:
            raise InputError(
                "restore: with drive.kind = 'wheels' the engine keeps a state, "
                "so it can be restored only into the environment that saved it"
            )
        self.put(*states)
        self.hands.restore(hands)
        self.base.restore(drive)

    def refuse_divergence(self) -> None:
        """Refuse bodies that move as none does.

        Raises
        ------
        SimulationError
            If one is faster than `MAX_SPEED` or turns faster than `MAX_RATE`.
        """
        for name, (vx, vy, rate) in self._velocities():
            # Written so that a NaN fails it.
            if not (vx * vx + vy * vy < MAX_SPEED**2 and abs(rate) < MAX_RATE):
                raise SimulationError(
                    f"the {name} moves at ({vx:.3g}, {vy:.3g}) m/s and {rate:.3g} rad/s: "
                    f"diverged (beyond {MAX_SPEED} m/s, {MAX_RATE} rad/s); "
                    "see what was commanded, and the gains of walker, grip and drive"
                )

    def _velocities(self) -> list[tuple[str, State]]:
        """Return name and (vx, vy, rate) of every body, m/s and rad/s."""
        n = len(self.human_state) // 2
        bodies = [("base", self.base_state[3:]), ("human", self.human_state[n : n + 3])]
        return [*bodies, ("load", self.load_state[3:])] if self.load else bodies

    def mean_drive(self) -> tuple[float, float]:
        """Return what the drive did since last asked (see `PlantState.drive`)."""
        force, torque = self.base.mean_drive()
        return force, torque + self.handle[1] * force

    def close(self) -> None:
        """Free the world. May be called twice."""
        self._free()
