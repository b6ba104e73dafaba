"""The way around what a human sees: how far beside the path it leads."""

from __future__ import annotations

import math

from cowalk.sim.basics.motion import Array

from ...basics.elementwise import FLOATS, Elementwise, Value


def rows_in_use(m: Elementwise, obstacles: Array) -> list[Value]:
    """Return the rows of an observation's obstacles that are in use, 4 values each.

    Parameters
    ----------
    m : Elementwise
    obstacles : ndarray, shape (..., rows, 4 or more)
        See `cowalk.sim.basics.observation.Observation`.
    """
    if m is FLOATS:
        return [row[:4] for row in obstacles.tolist() if row[0]]
    rows = []
    for i in range(obstacles.shape[-2]):
        if not m.any(obstacles[..., i, 0]):
            break  # rows in use come first
        # Together before each on its own: they lie far apart in a batch.
        rows.append(m.parts(obstacles[..., i, :4].copy()))
    return rows


def detour(
    m: Elementwise,
    offset: Value,
    axis: tuple[Value, Value],
    obstacles: list[Value],
    extent: tuple[float, float, float],
    margin: float,
    anticipation: float,
) -> Value:
    """Return the offset from the path that clears the nearest obstacle in the way, m.

    Parameters
    ----------
    m : Elementwise
    offset : float or ndarray, shape (...)
        Of the base from the path, m.
    axis : (float or ndarray, float or ndarray)
        Cosine and sine of the base's heading against the path.
    obstacles : list
        Rows of 4 values: present, and x, y, radius in base axes, m.
    extent, margin, anticipation
        See `cowalk.agents.humans.intention.intention.IntentionSettings`.
    """
    left, right, _ = extent
    behind = max(extent)  # whoever goes around the base's centre sweeps as far
    # Both bodies with their margin reach half of this about a middle beside the base's centre.
    breadth, shift = 0.5 * (left + right) + margin, offset + 0.5 * (right - left)
    cos, sin = axis
    aim, nearest = 0.0, math.inf
    for present, x, y, radius in obstacles:
        along = cos * x - sin * y
        across = sin * x + cos * y + shift
        half = radius + breadth
        in_the_way = (
            (abs(across) < half)
            & (present > 0.0)
            & (along + radius > -behind)
            & (along - radius < anticipation)
        )
        if len(obstacles) > 1:
            in_the_way = in_the_way & (along < nearest)
            nearest = m.where(in_the_way, along, nearest)
        # Both detours are open: left is not the longer one.
        aim = m.where(in_the_way, across + m.where(across <= 0.0, half, -half), aim)
    return aim
