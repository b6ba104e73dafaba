"""What a human's truth tells of each row: demand, insistence, and whether s can be known."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cowalk.sim.basics.motion import Array

START = 3.0
"""Time from which rows are judged, s: before it, the pair is getting under way."""
APART = 0.1
"""Disagreement, as a share of the upper bound, above which stubbornness can be read."""


def row_before(twist: ArrayLike) -> Array:
    """Return p_(k-1): what a human in row k felt and answered to.

    Parameters
    ----------
    twist : array_like, shape (..., rows, 2)
        Executed at the end of each row, m/s and rad/s.

    Returns
    -------
    ndarray, shape (..., rows, 2)
        NaN in the first row.
    """
    twist = np.asarray(twist, dtype=float)
    before = np.full_like(twist, np.nan)
    before[..., 1:, :] = twist[..., :-1, :]
    return before


def demand(
    stubbornness: ArrayLike, wish: ArrayLike, twist_before: ArrayLike, upper: ArrayLike
) -> Array:
    """Return s (p_H - p_(k-1))/p_ub: what force tells wherever it is not saturated.

    Parameters
    ----------
    stubbornness : array_like, shape (..., 2)
        s, in [0, 1]; NaN where a human has none.
    wish : array_like, shape (..., 2)
        p_H, m/s and rad/s; NaN where a human has none.
    twist_before : array_like, shape (..., 2)
        p_(k-1), see `row_before`.
    upper : array_like, shape (..., 2)
        p_ub, m/s and rad/s.

    Returns
    -------
    ndarray, shape (..., 2)
    """
    return np.asarray(np.multiply(stubbornness, np.subtract(wish, twist_before)) / upper)


def insistence(force_intent: ArrayLike, force_max: ArrayLike) -> Array:
    """Return |F_intent|/F_max: known of everybody, wish or none.

    Parameters
    ----------
    force_intent : array_like, shape (..., 2)
        What the human means to exert, N.
    force_max : array_like, shape (..., 2)
        Largest force of that person, N.

    Returns
    -------
    ndarray, shape (..., 2)
    """
    return np.asarray(np.abs(np.divide(force_intent, force_max)))


def identifiable(
    time: ArrayLike,
    stubbornness: ArrayLike,
    wish: ArrayLike,
    twist_before: ArrayLike,
    force_intent: ArrayLike,
    *,
    lower: ArrayLike,
    upper: ArrayLike,
    gain: ArrayLike,
    force_limit: ArrayLike,
) -> NDArray[np.bool_]:
    """Return in which rows stubbornness could be read from force, per dimension.

    From 3 s on, where the wish is known and

        |clip(p_H) - p_(k-1)| > 0.1 p_ub,
        kappa s |p_H - p_(k-1)|/p_ub < 1,
        |F_intent| < every limit of the force.

    In agreement force tells nothing of s; in saturation it tells a lower bound alone.

    Parameters
    ----------
    time : array_like, shape (..., rows)
        Since reset, s.
    stubbornness, wish : array_like, shape (..., rows, 2)
        s and p_H of the human's truth; NaN where there is none.
    twist_before : array_like, shape (..., rows, 2)
        p_(k-1), see `row_before`.
    force_intent : array_like, shape (..., rows, 2)
        N.
    lower, upper : array_like, shape (2,)
        Bounds of the twist, m/s and rad/s.
    gain : array_like
        kappa of that person, 1; broadcast against (..., rows, 2).
    force_limit : array_like
        The lowest of that person's limits (strength, fatigue, footing), N; broadcast against
        (..., rows, 2), so that it may change with the rows.

    Returns
    -------
    ndarray of bool, shape (..., rows, 2)
    """
    allowed = np.clip(wish, lower, upper)
    apart = np.abs(np.subtract(allowed, twist_before)) > APART * np.asarray(upper)
    unsaturated = np.asarray(gain) * np.abs(demand(stubbornness, wish, twist_before, upper)) < 1.0
    below = np.abs(force_intent) < np.asarray(force_limit)
    late = np.asarray(time, dtype=float)[..., None] >= START
    # A comparison with NaN is false: an unknown wish or stubbornness is never identifiable.
    return np.asarray(apart & unsaturated & below & late)
