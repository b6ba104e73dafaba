"""Utility of a motion primitive to the automation, and the primitive that it settles for.

Schneider et al., arXiv 2407.17275: U(p) = (J(p_H) - J(p)) / (J(p_H) - J(p_A*)), and the
negotiated primitive argmin |U(p) - U_target|. In omega alone that is one point between the
two wishes. In (v, omega) it is a whole level set, of which the point that costs the human
least is taken: the one on the Pareto front of the two wishes.
"""

from __future__ import annotations

import numpy as np

from cowalk.sim.motion import Array

from .planner import Problem

_SHARES = np.linspace(0.0, 1.0, 17), np.linspace(0.0, 1.0, 9)
_BRACKET, _BRACKET_LEAST = np.array([-1, 0]), np.array([0, 1])
_AGREED = 1e-12


def utility(cost: Array, human_cost: Array, own_cost: Array) -> Array:
    """Return U: 1 at the automation's wish, 0 at the human's.

    Parameters
    ----------
    cost, human_cost, own_cost : ndarray, shape (...)
        J of the primitive, of the human's wish and of the automation's own.

    Returns
    -------
    ndarray, shape (...)
        1 where both wishes cost the same: they agree.
    """
    gap = human_cost - own_cost
    agreed = gap <= _AGREED
    return np.where(agreed, 1.0, (human_cost - cost) / np.where(agreed, 1.0, gap))


def negotiated(problem: Problem, own: Array, human: Array, target: Array) -> Array:
    """Return the primitive on the Pareto front whose utility is the target.

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
    human_cost, own_cost = costs[..., :1], costs[..., 1:]
    gap = human_cost - own_cost
    goal = np.asarray(target)[..., None]
    low, width = np.zeros_like(gap), 1.0
    for shares in _SHARES:
        points, cost = problem.front(low + width * shares, own, human, gap)
        value = utility(cost, human_cost, own_cost)
        # Utility rises along the front: the first point at or above the target closes a bracket.
        reached = value >= goal
        last = np.where(reached.any(axis=-1), reached.argmax(axis=-1), shares.size - 1)[..., None]
        pair = np.maximum(last + _BRACKET, _BRACKET_LEAST)
        low, width = low + width * shares[pair[..., :1]], width / (shares.size - 1)
    ends = np.take_along_axis(value, pair, axis=-1)
    before, step = ends[..., :1], ends[..., 1:] - ends[..., :1]
    weight = (goal - before) / np.where(step > 0.0, step, np.inf)
    weight = np.minimum(np.maximum(weight, 0.0), 1.0)  # np.clip takes longer
    sides = np.take_along_axis(points, pair[..., None], axis=-2)
    settled = sides[..., 0, :] + weight * (sides[..., 1, :] - sides[..., 0, :])
    return np.where(gap <= _AGREED, own, settled)
