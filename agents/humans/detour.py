"""The way around what a human sees: how far beside the path it leads."""

from __future__ import annotations

import math

from cowalk.sim.motion import Array

from .elementwise import FLOATS, Elementwise, Value


def rows_in_use(m: Elementwise, obstacles: Array) -> list[Value]:
    """Return the rows of an observation's obstacles that are in use, 4 values each.

    Parameters
    ----------
    m : Elementwise
    obstacles : ndarray, shape (..., rows, 4 or more)
        See `cowalk.sim.observation.Observation`.
    """
    if m is FLOATS:
        return [row[:4] for row in obstacles.tolist() if row[0]]
    rows = []
    for i in range(obstacles.shape[-2]):
        (present,) = m.parts(obstacles[..., i, :1])
        if not m.any(present):
            break  # rows in use come first
        rows.append([present, *m.parts(obstacles[..., i, 1:4])])
    return rows


def detour(
    m: Elementwise,
    offset: Value,
    axis: tuple[Value, Value],
    obstacles: list[Value],
    extent: tuple[float, float],
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
        See `cowalk.agents.humans.intention.IntentionSettings`.
    """
    left, right = extent
    behind = max(left, right)
    cos, sin = axis
    aim, nearest = 0.0, math.inf
    for present, x, y, radius in obstacles:
        along = cos * x - sin * y
        across = sin * x + cos * y + offset
        reach = radius + margin
        pass_left, pass_right = across + (reach + right), across - (reach + left)
        in_the_way = (
            (present > 0.0)
            & (along + radius > -behind)
            & (along - radius < anticipation)
            & (pass_left > 0.0)
            & (pass_right < 0.0)
        )
        if len(obstacles) > 1:
            in_the_way = in_the_way & (along < nearest)
            nearest = m.where(in_the_way, along, nearest)
        # Both detours are open: left is not the longer one.
        shorter = m.where(pass_left + pass_right <= 0.0, pass_left, pass_right)
        aim = m.where(in_the_way, shorter, aim)
    return aim
