"""What a seat perceives after a control step."""

from __future__ import annotations

from typing import TypedDict

import numpy as np

from .motion import Array, world_to_base
from .world import World

OBSTACLE_ROWS = 8
"""Rows of the ``obstacles`` observation: the nearest that a seat perceives."""


class Observation(TypedDict):
    """What a seat perceives after a control step (leading batch axes come first).

    Keys
    ----
    twist : ndarray, shape (..., 2)
        Executed twist of the base, m/s and rad/s.
    force : ndarray, shape (..., samples, 2)
        Force of the human on the base at every sensor sample of the last control step, base
        axes, N. The automation gets the sensor's reading, the human feels the force itself.
    force_valid : ndarray, shape (..., samples)
        1 where the sample arrived, 0 where it was lost and ``force`` repeats the one before.
    pose : ndarray, shape (..., 3)
        Base pose relative to the path: station m, lateral offset m (left positive), heading rad.
    obstacles : ndarray, shape (..., rows, 4)
        Obstacles the seat perceives in base axes, nearest first: ``[present, x, y, radius]``
        with present 1 or 0, and m; rows that are not in use are zero.
    time : ndarray, shape (..., 1)
        Time since reset, s.
    """

    twist: Array
    force: Array
    force_valid: Array
    pose: Array
    obstacles: Array
    time: Array


class Eyes:
    """The obstacles that a seat perceives.

    Parameters
    ----------
    world : World
    seat : str
        ``"human"`` or ``"automation"``.
    """

    def __init__(self, world: World, seat: str) -> None:
        seen = [(o.x, o.y, o.radius) for o in world.obstacles if seat in o.seen_by]
        self._discs = np.array(seen, dtype=float).reshape(-1, 3)

    def look(self, pose_world: tuple[float, float, float]) -> Array:
        """Return the ``obstacles`` of an `Observation`, shape (8, 4), from a base pose."""
        rows = np.zeros((OBSTACLE_ROWS, 4))
        discs = self._discs
        if not len(discs):
            return rows
        centres = world_to_base(np.array(pose_world), discs[:, :2])
        if len(discs) > 1:
            gap = np.hypot(centres[:, 0], centres[:, 1]) - discs[:, 2]
            nearest = np.argsort(gap, kind="stable")[:OBSTACLE_ROWS]
            centres, discs = centres[nearest], discs[nearest]
        rows[: len(discs), 0] = 1.0
        rows[: len(discs), 1:3] = centres
        rows[: len(discs), 3] = discs[:, 2]
        return rows
