"""What both seats perceive, put together from the plant's state and the sensor's reading."""

from __future__ import annotations

import numpy as np
from gymnasium.spaces import Box, Dict

from ..basics.observation import OBSTACLE_COLUMNS, OBSTACLE_ROWS, Observation
from ..basics.seats import SEATS
from ..plant.protocol import PlantState
from ..sensor.sensor import Reading
from ..world.eyes import Eyes
from ..world.outline import Bodies
from ..world.world import World
from .steering import as_felt


def observation_space(samples: int) -> Dict:
    """Return the space of an `Observation` with so many force samples, the same for both seats."""
    shapes: dict[str, tuple[int, ...]] = {
        "twist": (2,),
        "force": (samples, 2),
        "wrench": (samples, 6),
        "force_valid": (samples,),
        "pose": (3,),
        "pose_world": (3,),
        "obstacles": (OBSTACLE_ROWS, OBSTACLE_COLUMNS),
        "time": (1,),
    }
    return Dict({name: Box(-np.inf, np.inf, shape, np.float64) for name, shape in shapes.items()})


class Perception:
    """Both seats' observations: fresh arrays, so that nobody's writing reaches anybody else.

    Parameters
    ----------
    world : World
    bodies : Bodies
        Where each seat sees from.
    samples : int
        Force samples in a control step.
    from_behind : bool
        Whether a push to the left asks for a turn to the right (`Plant.steers_from_behind`).
    """

    def __init__(self, world: World, bodies: Bodies, samples: int, from_behind: bool) -> None:
        self._human, self._automation = (Eyes(world, seat, bodies.eyes[seat]) for seat in SEATS)
        self._arrived = np.ones(samples)
        self._from_behind = from_behind

    def __call__(
        self,
        state: PlantState,
        reading: Reading,
        relative_pose: tuple[float, float, float],
        time: float,
    ) -> dict[str, Observation]:
        """Return what each seat perceives.

        Parameters
        ----------
        state : PlantState
        reading : Reading
            The sensor's, of the last control step; the human feels the force itself.
        relative_pose : (station, offset, heading)
            Base pose relative to the path: m, m, rad.
        time : float
            Since reset, s.
        """
        pose, human_pose = state.pose, state.human_pose
        felt = as_felt(state.wrench_on_base, self._from_behind)
        read = as_felt(reading.wrench_on_base, self._from_behind)
        return {
            "human": Observation(
                twist=np.array(state.twist),
                force=felt[:, :2].copy(),
                wrench=felt,
                force_valid=self._arrived.copy(),
                pose=np.array(relative_pose),
                pose_world=np.array(pose),
                obstacles=self._human.look(pose, human_pose, time),
                time=np.array([time]),
            ),
            "automation": Observation(
                twist=np.array(state.twist),
                force=read[:, :2].copy(),
                wrench=read,
                force_valid=reading.valid.astype(float),
                pose=np.array(relative_pose),
                pose_world=np.array(pose),
                obstacles=self._automation.look(pose, human_pose, time),
                time=np.array([time]),
            ),
        }
