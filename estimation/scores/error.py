"""How far an estimate is from the truth, and on how many rows that rests."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array


class Score(NamedTuple):
    """A score, and what it rests on.

    Attributes
    ----------
    value : ndarray, shape (...)
        NaN where there is no row to judge by.
    share : ndarray, shape (...)
        Rows judged, as a share of all rows. Whoever is silent where it is hard is shown by it.
    """

    value: Array
    share: Array


def squared_error(estimate: ArrayLike, truth: ArrayLike, rows: ArrayLike = True) -> Score:
    """Return the mean squared error: what is averaged over runs and people before the root.

    mean of (estimate - truth)^2 over the rows asked for in which both are known.

    Parameters
    ----------
    estimate, truth : array_like, shape (..., rows)
        NaN where unknown.
    rows : array_like of bool, shape (..., rows)
        Rows to judge by; all, unless given.
    """
    return mean_over_rows(np.square(np.subtract(estimate, truth)), rows)


def rmse(estimate: ArrayLike, truth: ArrayLike, rows: ArrayLike = True) -> Score:
    """Return the root-mean-square error of one run, in the units of the signals.

    Parameters
    ----------
    estimate, truth, rows
        See `squared_error`. Over several runs, average the squares (`mean_over_people`).
    """
    square, share = squared_error(estimate, truth, rows)
    return Score(np.sqrt(square), share)


def bias(estimate: ArrayLike, truth: ArrayLike, rows: ArrayLike = True) -> Score:
    """Return the mean error, estimate minus truth, in the units of the signals.

    Parameters
    ----------
    estimate, truth, rows
        See `squared_error`.
    """
    return mean_over_rows(np.subtract(estimate, truth), rows)


def mean_over_rows(values: ArrayLike, rows: ArrayLike = True) -> Score:
    """Return the mean of known values over the rows asked for.

    Parameters
    ----------
    values : array_like, shape (..., rows)
        NaN where unknown.
    rows : array_like of bool, shape (..., rows)
    """
    values = np.asarray(values, dtype=float)
    judged = np.isfinite(values) & np.asarray(rows, dtype=bool)
    count = judged.sum(axis=-1)
    total = np.where(judged, values, 0.0).sum(axis=-1)
    mean = np.where(count > 0, total / np.maximum(count, 1), np.nan)
    return Score(mean, np.asarray(count / max(judged.shape[-1], 1)))
