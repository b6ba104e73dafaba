"""Utility of a motion primitive to the automation, and the primitive that it settles for.

Schneider et al., arXiv 2407.17275: U(p) = (J(p_H) - J(p)) / (J(p_H) - J(p_A*)), and the
negotiated primitive argmin |U(p) - U_target|. In omega alone that is one point between the
two wishes. In (v, omega) it is a whole level set, of which the point that costs the human
least is taken: the one on the Pareto front of the two wishes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cowalk.sim.basics.motion import Array

from .problem import Problem

_PARTS = 8
_STEPS = np.linspace(0.0, 1.0, _PARTS + 1)[:, None]
_BRACKET, _BRACKET_LEAST = np.array([-1, 0]), np.array([0, 1])
_AGREED = 1e-12


def negotiated(problem: Problem, own: Array, human: Array, target: Array) -> Array:
    """Return the primitive whose utility is the target: on the Pareto front, or closing a gap.

    J is continuous, so the target is met on the straight line between the two neighbours on the
    front that enclose it. Where the front has a gap (its costs do not bend outwards there, as on
    sharply bent paths), that line leads past it, and the point may cost the human more than
    the best of that utility would.

    Parameters
    ----------
    problem : Problem
    own, human : ndarray, shape (..., 2)
        p_A* and the estimated human wish, m/s and rad/s.
    target : ndarray, shape (...)
        Target utility in [0, 1].

    Returns
    -------
    ndarray, shape (..., 2)
        The automation's own wish where both wishes cost the same.
    """
    costs = problem.cost(np.stack((human, own), axis=-2))
    gap = costs[..., :1] - costs[..., 1:]
    level = costs[..., :1] - np.asarray(target)[..., None] * gap
    points, cost = problem.front(own, human, gap)
    points[..., 0, :], points[..., -1, :] = human, own
    cost[..., 0], cost[..., -1] = costs[..., 0], costs[..., 1]
    ends = np.take_along_axis(points, _enclosing(cost, level)[..., None], axis=-2)
    start, way = ends[..., :1, :], ends[..., 1:, :] - ends[..., :1, :]
    left, width = np.zeros_like(level), 1.0
    for _ in range(2):
        cost = problem.cost(start + (left[..., None] + width * _STEPS) * way)
        pair = _enclosing(cost, level)
        width /= _PARTS
        left = left + width * pair[..., :1]
    ends = np.take_along_axis(cost, pair, axis=-1)
    before, fall = ends[..., :1], ends[..., :1] - ends[..., 1:]
    weight = (before - level) / np.where(fall > 0.0, fall, np.inf)
    place = left + width * np.minimum(np.maximum(weight, 0.0), 1.0)  # np.clip takes longer
    settled = start[..., 0, :] + place * way[..., 0, :]
    return np.where(gap <= _AGREED, own, settled)


def _enclosing(cost: Array, level: Array) -> NDArray[np.int_]:
    """Return the numbers of the two points around a level of cost: before, and at or below it.

    Parameters
    ----------
    cost : ndarray, shape (..., n)
        Of points from the human's wish, which costs more, to the automation's.
    level : ndarray, shape (..., 1)

    Returns
    -------
    ndarray of int, shape (..., 2)
        The second is the first that costs so little; the last two, if none does.
    """
    reached = cost <= level
    first = np.where(reached.any(axis=-1), reached.argmax(axis=-1), cost.shape[-1] - 1)
    return np.asarray(np.maximum(first[..., None] + _BRACKET, _BRACKET_LEAST))
