"""The made-up walk on which agents are tested: what they meet in a run, without a plant."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cowalk.sim.basics.motion import Array, TwistBounds
from cowalk.sim.basics.observation import OBSTACLE_COLUMNS, OBSTACLE_ROWS, Observation
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.situation import Situation

SITUATION = Situation(
    Path(((0.0, 0.0), (30.0, 0.0))), 0.8, TwistBounds((0.0, -0.5), (1.2, 0.5)), 0.05
)
STEPS = 160
_SAMPLES = 12
_OFF, _HALT, _ON = 10, 100, 112
"""Steps at which the base sets off from rest, stands still, and goes on."""
_CLEAR, _CROWDED = 40, 120
"""Steps up to which no obstacle is seen, and from which on several are."""
_LOST = {30: slice(4, 7), 60: slice(None)}
"""Samples of the force that are lost, by step."""
_OBSTACLES = ((4.0, -0.6, 0.3), (6.0, 1.1, 0.4), (7.5, -1.4, 0.2), (9.0, 0.3, 0.5))
"""x, y and radius, world axes, m."""


def observations(motion: float, push: float) -> Iterator[Observation]:
    """Yield a walk from rest, with a halt, past nothing, a puddle, and several obstacles.

    Parameters
    ----------
    motion : float
        Scales how far the base's twist swings about a steady walk, 1.
    push : float
        Scales the measured force, 1.
    """
    pose = np.zeros(3)
    for step in range(STEPS):
        time = step * SITUATION.period
        v = 0.7 + 0.2 * motion * np.sin(2.0 * time)
        twist = _going(step) * np.array([v, 0.25 * motion * np.cos(1.4 * time)])
        turned = np.array([np.cos(pose[2]), np.sin(pose[2])])
        pose = pose + SITUATION.period * np.array([*(twist[0] * turned), twist[1]])
        force = push * np.array([1.5 * np.sin(time), 3.0 * np.sin(0.9 * time)])
        wrist = 0.2 * push * np.sin(0.7 * time)
        valid = np.ones(_SAMPLES)
        valid[_LOST.get(step, slice(0))] = 0.0
        yield Observation(
            twist=twist,
            force=np.tile(force, (_SAMPLES, 1)),
            wrench=np.tile((*force, 0.0, 0.0, 0.0, wrist), (_SAMPLES, 1)),
            force_valid=valid,
            pose=pose.copy(),
            pose_world=pose.copy(),  # the path is the world's x axis
            obstacles=_seen(step, pose),
            time=np.array([time]),
        )


def _going(step: int) -> float:
    """Return the share of its speed at which the base walks: 0 is exact rest."""
    if step < _OFF or _HALT <= step < _ON:
        return 0.0
    since = step - (_OFF if step < _HALT else _ON)
    return min(1.0, (since + 1) / 10)


def _seen(step: int, pose: Array) -> Array:
    rows = np.zeros((OBSTACLE_ROWS, OBSTACLE_COLUMNS))
    count = 0 if step < _CLEAR else 1 if step < _CROWDED else len(_OBSTACLES)
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    for row, (x, y, radius) in zip(rows, _OBSTACLES[:count], strict=False):
        east, north = x - pose[0], y - pose[1]
        row[:4] = (1.0, cos * east + sin * north, cos * north - sin * east, radius)
    return np.asarray(sorted(rows, key=lambda row: (1.0 - row[0], float(np.hypot(*row[1:3])))))
