"""The made-up walk on which agents are tested: what they meet in a run, without a plant."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cowalk.estimation.checks.stream import LOST, motion
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import OBSTACLE_COLUMNS, OBSTACLE_ROWS, Observation

_SAMPLES = 12
_CLEAR, _CROWDED = 40, 120
"""Steps up to which no obstacle is seen, and from which on several are."""
_OBSTACLES = ((4.0, -0.6, 0.3), (6.0, 1.1, 0.4), (7.5, -1.4, 0.2), (9.0, 0.3, 0.5))
"""x, y and radius, world axes, m."""


def observations(swing: float, push: float) -> Iterator[Observation]:
    """Yield a walk from rest, with a halt, past nothing, a puddle, and several obstacles.

    Parameters
    ----------
    swing : float
        Scales how far the base's twist swings about a steady walk, 1.
    push : float
        Scales the measured force, 1.
    """
    for step, (time, twist, pose) in enumerate(motion(swing)):
        force = push * np.array([1.5 * np.sin(time), 3.0 * np.sin(0.9 * time)])
        wrist = 0.2 * push * np.sin(0.7 * time)
        valid = np.ones(_SAMPLES)
        valid[LOST.get(step, slice(0))] = 0.0
        yield Observation(
            twist=twist,
            force=np.tile(force, (_SAMPLES, 1)),
            wrench=np.tile((*force, 0.0, 0.0, 0.0, wrist), (_SAMPLES, 1)),
            force_valid=valid,
            pose=pose.copy(),
            pose_world=pose,  # the path is the world's x axis
            obstacles=_seen(step, pose),
            time=np.array([time]),
        )


def _seen(step: int, pose: Array) -> Array:
    rows = np.zeros((OBSTACLE_ROWS, OBSTACLE_COLUMNS))
    count = 0 if step < _CLEAR else 1 if step < _CROWDED else len(_OBSTACLES)
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    for row, (x, y, radius) in zip(rows, _OBSTACLES[:count], strict=False):
        east, north = x - pose[0], y - pose[1]
        row[:4] = (1.0, cos * east + sin * north, cos * north - sin * east, radius)
    return np.asarray(sorted(rows, key=lambda row: (1.0 - row[0], float(np.hypot(*row[1:3])))))
