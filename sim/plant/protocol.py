"""The protocol of a plant: what moves when the two seats act, and what is measured.

Two plants ship, `cowalk.sim.unicycle.plant` (kinematic, the paper's) and `cowalk.sim.bullet.plant`
(rigid bodies in PyBullet, the interaction force being a constraint's reaction).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ..basics.motion import Array
from ..sensor.wrench import AT_HANDLE, SensorMount, in_sensor_frame
from ..world.clearance import Distances
from ..world.outline import Bodies
from ..world.world import World


@dataclass(frozen=True, slots=True)
class PlantState:
    """What a plant reports after a control step.

    Attributes
    ----------
    pose : (x, y, theta)
        Base pose at the end of the step, world axes: m, m, rad.
    twist : (v, omega)
        Executed twist of the base at the end of the step, base axes: m/s, rad/s.
    human_pose : (x, y, theta)
        Pose of the human's trunk, world axes: m, m, rad.
    wrench_on_base : ndarray, shape (samples, 6)
        Force (N) and torque about the handle (N m) of the human on the base, base axes, at every
        sensor instant of the step, oldest first, before the sensor. A fresh array each step.
        What a plant does not know is 0: one that moves points has no torque.
    mount : SensorMount
        Where the sensor sits.
    grip_held : bool
        Whether human and base still hold on to each other.
    footing_held : bool
        Whether the human has not lost their footing.
    end : str or None
        Why the plant asks for the end of the episode, if it does: ``"grip lost"``, or
        ``"lost footing"``.
    time : float
        Since reset, s.
    load_pose : (x, y, theta), optional
        Of what the two carry, world axes: m, m, rad.
    work : float
        Of the human on the base at the handle during the step, J: the integral of F v + M omega
        over the physics steps. NaN for a plant that does not know it.
    drive : (force, torque)
        Of the ground on the base along it, N, and about the point of its axle beside the
        handle, N m, base axes: means over the step. There a push along the base has no lever,
        so that the torque tells of turning alone. NaN where it is not known.
    """

    pose: tuple[float, float, float]
    twist: tuple[float, float]
    human_pose: tuple[float, float, float]
    wrench_on_base: Array
    mount: SensorMount = AT_HANDLE
    grip_held: bool = True
    footing_held: bool = True
    end: str | None = None
    time: float = 0.0
    load_pose: tuple[float, float, float] | None = None
    work: float = math.nan
    drive: tuple[float, float] = (math.nan, math.nan)

    @property
    def poses(self) -> tuple[tuple[float, float, float], ...]:
        """Of base, human and, where there is one, load: in the order of `Bodies.outlines`."""
        if self.load_pose is None:
            return self.pose, self.human_pose
        return self.pose, self.human_pose, self.load_pose

    @property
    def force_on_base(self) -> Array:
        """The planar force of the human on the base, base axes, N, shape (samples, 2)."""
        return self.wrench_on_base[:, :2]

    @property
    def wrench_on_sensor(self) -> Array:
        """The wrench about the sensor's origin, sensor axes, shape (samples, 6), N and N m."""
        return in_sensor_frame(self.wrench_on_base, self.mount)


class Plant(Protocol):
    """What `cowalk.sim.env.env` steps. Built with `Rates`; holds no random state of its own."""

    @property
    def steers_from_behind(self) -> bool:
        """Whether a push to the left asks for a turn to the right, as at the tail of a trailer."""
        ...

    @property
    def bodies(self) -> Bodies:
        """What it moves: outlines, and where the seats see from. It never changes."""
        ...

    @property
    def wheels(self) -> tuple[float, float] | None:
        """Track and radius of the driven wheels, m, or None where there are none."""
        ...

    def reset(
        self, world: World, rng: np.random.Generator, twist: tuple[float, float] = (0.0, 0.0)
    ) -> PlantState:
        """Put base and human at the world's start, at a twist, and return the state there.

        Its wrench is the standing one, before anybody pushes: what a load that is clamped on
        weighs, 0 without one. The sensor is tared with it.

        Parameters
        ----------
        world : World
        rng : numpy.random.Generator
        twist : (v, omega)
            Of the base, in its axes, m/s and rad/s, as the drive's limits leave it. All that
            moves moves as one with it: going straight on takes no force.
        """
        ...

    def step(
        self, twist_command: tuple[float, float], hand_force: tuple[float, float]
    ) -> PlantState:
        """Advance one control period.

        Parameters
        ----------
        twist_command : (v, omega)
            Commanded twist of the base in m/s, rad/s.
        hand_force : (fx, fy)
            Force that the human intends to exert on the base, base axes, N.

        Raises
        ------
        SimulationError
            If the state is not finite any more, or a body moves faster than is plausible.
        """
        ...

    def save(self) -> Any:
        """Return the whole state within an episode: opaque, and never changed."""
        ...

    def restore(self, saved: Any) -> PlantState:
        """Go on from what `save` gave, bit for bit; the state's force samples are void."""
        ...

    def distances(self, world: World) -> Distances:
        """Return what measures how far its bodies are from everything in a world.

        It is called with the time and `PlantState.poses`, until it or the plant is closed.
        """
        ...

    def render(self, width: int, height: int) -> np.ndarray:
        """Return a picture of the present state, uint8, shape (height, width, 3)."""
        ...

    def close(self) -> None:
        """Free what the plant holds. May be called twice."""
        ...
