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
    goal = np.broadcast_to(target, own.shape[:-1])[..., None]
    low, high = np.zeros_like(goal), np.ones_like(goal)
    for shares in _SHARES:
        share = low + (high - low) * shares
        points = problem.front(share, own, human)
        value = utility(problem.cost(points), human_cost, own_cost)
        # Utility rises along the front: the first point at or above the target closes a bracket.
        reached = value >= goal
        last = np.where(reached.any(axis=-1), np.argmax(reached, axis=-1), shares.size - 1)
        pair = np.maximum(last - 1, 0)[..., None], np.maximum(last, 1)[..., None]
        low, high = (np.take_along_axis(share, at, axis=-1) for at in pair)
    before, after = (np.take_along_axis(value, at, axis=-1) for at in pair)
    step = after - before
    weight = np.clip((goal - before) / np.where(step > 0.0, step, 1.0), 0.0, 1.0)
    first, second = (np.take_along_axis(points, at[..., None], axis=-2)[..., 0, :] for at in pair)
    settled = first + weight * (second - first)
    return np.where(human_cost - own_cost <= _AGREED, own, settled)
