"""Scores of a stated uncertainty: the continuous ranked probability score, and coverage.

A mean m and a deviation d are read as a normal distribution whose mass beyond an end of what
is possible is put onto that end: that of the normal estimate clipped to [0, 1]. People who
insist not at all, or fully, lie at the ends. Cutting the mass off and scaling the rest up
would make the distribution narrower than stated, and reward stating too much: on a uniform
belief without bound.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtr, ndtri

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from .error import Score, mean_over_rows

Within = tuple[float, float]
ANYWHERE: Within = (-np.inf, np.inf)
SHARE: Within = (0.0, 1.0)
"""What is possible of stubbornness."""


def crps(
    truth: ArrayLike, mean: ArrayLike, deviation: ArrayLike, within: Within = ANYWHERE
) -> Array:
    """Return the continuous ranked probability score of a mean and a deviation, row by row.

    CRPS = integral over ``within`` of (F(x) - [x >= truth])^2 dx, F normal, in closed form; less
    is better. |mean - truth| where the deviation is 0 or NaN: an estimate without uncertainty.

    Parameters
    ----------
    truth, mean, deviation : array_like, shape (...)
        Deviation of at least 0. What lies beyond ``within`` is clipped to it.
    within : (float, float)
        What is possible; `SHARE` for stubbornness.

    Returns
    -------
    ndarray, shape (...)
        In the units of the truth; NaN where truth or mean is unknown.

    Raises
    ------
    InputError
        If a deviation is negative.

    Notes
    -----
    Gneiting and Raftery 2007, J. Am. Stat. Assoc. 102:359. With z = (x - m)/d,

        G(z) = int Phi^2 = z Phi^2 + 2 Phi phi - Phi(sqrt(2) z)/sqrt(pi),
        H(z) = int (1 - Phi)^2 = -G(-z),

    CRPS = d (G(z_truth) - G(z_low) + H(z_high) - H(z_truth)).
    """
    truth, mean = np.clip(truth, *within), np.asarray(mean, dtype=float)
    deviation = np.asarray(deviation, dtype=float)
    if np.any(deviation < 0.0):
        raise InputError("deviation: must be at least 0", ("deviation",))
    stated = deviation > 0.0
    scale = np.where(stated, deviation, 1.0)
    at = (truth - mean) / scale
    low, high = (within[0] - mean) / scale, (within[1] - mean) / scale
    spread = scale * (_below(at) - _below(low) + _below(-at) - _below(-high))
    return np.where(stated, spread, np.abs(np.clip(mean, *within) - truth))


def _below(z: Array) -> Array:
    """Return the integral of Phi^2 from minus infinity to z."""
    z = np.maximum(z, -40.0)  # as good as minus infinity, and finite times 0
    mass, density = ndtr(z), np.exp(-0.5 * np.minimum(z, 40.0) ** 2) / np.sqrt(2.0 * np.pi)
    return np.asarray(z * mass**2 + 2.0 * mass * density - ndtr(np.sqrt(2.0) * z) / np.sqrt(np.pi))


def crps_discrete(truth: ArrayLike, values: ArrayLike, weights: ArrayLike) -> Array:
    """Return the score of a distribution over single values: a histogram, a grid, samples.

    CRPS = E|X - truth| - E|X - X'|/2, X and X' independent.

    Parameters
    ----------
    truth : array_like, shape (...)
    values : array_like, shape (values,)
        In increasing order.
    weights : array_like, shape (..., values)
        Probabilities; they are scaled to a sum of 1.

    Returns
    -------
    ndarray, shape (...)
    """
    values = np.asarray(values, dtype=float)
    weights = np.asarray(weights, dtype=float)
    weights = weights / weights.sum(axis=-1, keepdims=True)
    away = np.sum(weights * np.abs(values - np.asarray(truth, dtype=float)[..., None]), axis=-1)
    # E|X - X'|/2 is the integral of F (1 - F).
    below = np.cumsum(weights, axis=-1)[..., :-1]
    return np.asarray(away - np.sum(below * (1.0 - below) * np.diff(values), axis=-1))


def crps_skill(score: ArrayLike, prior: ArrayLike, rows: ArrayLike = True) -> Score:
    """Return 1 - sum CRPS / sum CRPS of a prior, on the same rows.

    1 is perfect, 0 as good as the prior, negative worse. Where an estimate is silent (NaN), it
    counts as the prior: silence neither costs nor earns, nor does choosing one's rows.

    Parameters
    ----------
    score, prior : array_like, shape (..., rows)
        CRPS row by row; a row counts where that of the prior is known.
    rows : array_like of bool, shape (..., rows)

    Returns
    -------
    Score
        Value NaN where the prior is never wrong; the share is that of the rows compared.
    """
    scores, priors = np.broadcast_arrays(np.asarray(score, float), np.asarray(prior, float))
    gained = mean_over_rows(priors - np.where(np.isfinite(scores), scores, priors), rows)
    beside = mean_over_rows(priors, rows)
    positive = beside.value > 0.0
    return Score(
        np.where(positive, gained.value / np.where(positive, beside.value, 1.0), np.nan),
        gained.share,
    )


def central_interval(
    mean: ArrayLike, deviation: ArrayLike, level: float, within: Within = ANYWHERE
) -> tuple[Array, Array]:
    """Return the ends of the central interval that holds a share of the probability.

    Parameters
    ----------
    mean, deviation : array_like, shape (...)
        Read as in `crps`. Without a deviation (NaN), the interval is the mean alone.
    level : float
        Share of the probability, in (0, 1).
    within : (float, float)
        What is possible.

    Returns
    -------
    (ndarray, ndarray), each of shape (...)

    Raises
    ------
    InputError
        If the level does not lie in (0, 1).
    """
    if not 0.0 < level < 1.0:
        raise InputError(f"level = {level}: must lie between 0 and 1", ("level",))
    half = ndtri(0.5 + 0.5 * level) * np.nan_to_num(np.asarray(deviation, dtype=float))
    return np.clip(mean - half, *within), np.clip(mean + half, *within)


class Coverage(NamedTuple):
    """How often intervals held the truth, and how wide they were.

    Attributes
    ----------
    value : ndarray, shape (...)
        Share of the rows whose interval holds the truth; honest is the level.
    width : ndarray, shape (...)
        Mean width on the same rows, in the units of the truth.
    share : ndarray, shape (...)
        Rows judged, as a share of all rows.
    """

    value: Array
    width: Array
    share: Array


def coverage(truth: ArrayLike, low: ArrayLike, high: ArrayLike, rows: ArrayLike = True) -> Coverage:
    """Return how often intervals hold the truth, with their mean width.

    Parameters
    ----------
    truth, low, high : array_like, shape (..., rows)
        Ends from `central_interval`, or quantiles of a posterior; both count as inside.
    rows : array_like of bool, shape (..., rows)
    """
    truth, low, high = (np.asarray(each, dtype=float) for each in (truth, low, high))
    inside = np.where((low <= truth) & (truth <= high), 1.0, 0.0)
    known = np.isfinite(truth) & np.isfinite(low) & np.isfinite(high)
    held = mean_over_rows(np.where(known, inside, np.nan), rows)
    width = mean_over_rows(np.where(known, high - low, np.nan), rows)
    return Coverage(held.value, width.value, held.share)
