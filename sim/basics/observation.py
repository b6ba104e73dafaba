"""What a seat perceives after a control step."""

from __future__ import annotations

from typing import TypedDict

from .motion import Array

OBSTACLE_ROWS = 8
"""Rows of the ``obstacles`` observation: the nearest that a seat perceives."""
OBSTACLE_COLUMNS = 6
"""``[present, x, y, radius, vx, vy]``."""


class Observation(TypedDict):
    """What a seat perceives after a control step (leading batch axes come first).

    Keys
    ----
    twist : ndarray, shape (..., 2)
        Executed twist of the base, m/s and rad/s.
    force : ndarray, shape (..., samples, 2)
        Force of the human on the base at every sensor sample of the last control step, base
        axes, N. The automation gets what the sensor read, the human feels the force itself.
        Where the hands hold on behind the point about which the base turns, the sideways force
        has the sign of the turn that it asks for (`cowalk.sim.env.steering`).
    wrench : ndarray, shape (..., samples, 6)
        The same force (N), and the torque about the handle (N m), base axes.
    force_valid : ndarray, shape (..., samples)
        1 where the sample arrived, 0 where it was lost and ``force`` and ``wrench`` repeat the one
        before.
    pose : ndarray, shape (..., 3)
        Base pose relative to the path: station m, lateral offset m (left positive), heading rad.
    pose_world : ndarray, shape (..., 3)
        Base pose in the world: m, m, rad.
    obstacles : ndarray, shape (..., rows, 6)
        Obstacles the seat perceives in base axes, nearest first: ``[present, x, y, radius, vx,
        vy]`` with present 1 or 0, m, and m/s over ground; rows that are not in use are zero.
    time : ndarray, shape (..., 1)
        Time since reset, s.
    """

    twist: Array
    force: Array
    wrench: Array
    force_valid: Array
    pose: Array
    pose_world: Array
    obstacles: Array
    time: Array
