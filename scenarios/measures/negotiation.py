"""Who gets their way, and for how long nobody does: per dimension, v and omega. Rows come last."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cowalk.estimation.scores.error import Score, mean_over_rows
from cowalk.estimation.scores.rows import APART
from cowalk.sim.basics.motion import Array

from .cost import rms

STRIDE = 1.4
"""Two steps at an easy walk, s: a mean over it is free of gait."""
LEAST_SHARE = 0.02
"""Rows on which a concession rests at least, as a share of all (inferred): half a second of 30."""

LETS_GO = 0.05
"""Stubbornness up to which a human lets go (inferred)."""
UNDER_WAY = 4.0
"""Time from which a concession is judged as false, s."""


def apart(wish: ArrayLike, executed: ArrayLike, upper: ArrayLike) -> NDArray[np.bool_]:
    r"""Return in which rows |p_H - p| > 0.1 p_ub: false where the wish is not known.

    Parameters
    ----------
    wish, executed : array_like, shape (..., rows)
        p_H and p, or any two twists, in one dimension a row: m/s or rad/s.
    upper : array_like, shape (...)
        p_ub, in the same units.

    Returns
    -------
    ndarray of bool, shape (..., rows)
    """
    return np.asarray(np.abs(np.subtract(wish, executed)) > APART * np.asarray(upper)[..., None])


def time_apart(wish: ArrayLike, executed: ArrayLike, upper: ArrayLike, period: float) -> Score:
    """Return for how long human and base are `apart`, s, and the share of rows with a known wish.

    Parameters
    ----------
    wish, executed, upper
        See `apart`.
    period : float
        Control period, s.

    Returns
    -------
    Score
        Of shape (...): NaN where no wish is known.
    """
    known = np.isfinite(np.asarray(wish, dtype=float))
    share = np.asarray(known.mean(axis=-1))
    time = apart(wish, executed, upper).sum(axis=-1) * period
    return Score(np.where(share > 0.0, time, np.nan), share)


def executed_concession(
    own: ArrayLike, human: ArrayLike, executed: ArrayLike, upper: ArrayLike
) -> Score:
    r"""Return which share of the gap between both wishes was conceded in what was executed.

    sum (p - p_A*) sgn(p_H - p_A*) / sum |p_H - p_A*| over the rows in which the wishes differ
    by more than 0.1 p_ub: 0 where the automation gets its way, 1 where the human does, below 0
    where the base turns away from both. Between the wishes that is |p - p_A*|/|p_H - p_A*|,
    weighted by what is at stake; the sign keeps wobbling from counting as concession.

    Parameters
    ----------
    own, human, executed : array_like, shape (..., rows)
        p_A*, p_H and p, m/s or rad/s.
    upper : array_like, shape (...)
        p_ub, in the same units.

    Returns
    -------
    Score
        Of shape (...): NaN where the wishes differ in less than `LEAST_SHARE` of the rows.
    """
    gap = np.subtract(human, own)
    rows = apart(human, own, upper) & np.isfinite(gap)
    conceded = np.where(rows, (np.asarray(executed) - own) * np.sign(gap), 0.0).sum(axis=-1)
    at_stake = np.where(rows, np.abs(gap), 0.0).sum(axis=-1)
    share = np.asarray(rows.mean(axis=-1))
    with np.errstate(divide="ignore", invalid="ignore"):
        return Score(np.where(share >= LEAST_SHARE, conceded / at_stake, np.nan), share)


def false_concession(
    own: ArrayLike,
    command: ArrayLike,
    stubbornness: ArrayLike,
    upper: ArrayLike,
    time: ArrayLike,
) -> Score:
    r"""Return in which share of the rows something is conceded to a human who asks for nothing.

    |p_cmd - p_A*| > 0.1 p_ub, from 4 s on, where s is at most `LETS_GO`: what was taken for a
    wish is gait, or noise.

    Parameters
    ----------
    own, command, stubbornness : array_like, shape (..., rows)
        p_A* and p_cmd, m/s or rad/s; s, NaN where unknown.
    upper : array_like, shape (...)
        p_ub, in the same units.
    time : array_like, shape (rows,)
        s.

    Returns
    -------
    Score
        Of shape (...): NaN for a human who never lets go.
    """
    rows = (np.asarray(stubbornness) <= LETS_GO) & (np.asarray(time) >= UNDER_WAY)
    return mean_over_rows(apart(command, own, upper).astype(float), rows)


def ripple(force_true: ArrayLike, force_intent: ArrayLike) -> Array:
    """Return the RMS of what body and gait add to a person's intended force, about its mean, N.

    Parameters
    ----------
    force_true, force_intent : array_like, shape (..., rows)
        On the base, before the sensor; as meant, N.

    Returns
    -------
    ndarray, shape (...)
    """
    added = np.subtract(force_true, force_intent)
    return rms(added - np.mean(added, axis=-1, keepdims=True))


def stride_ripple(values: ArrayLike, period: float) -> Array:
    """Return the RMS of what a mean over a stride leaves of a signal, in its units.

    Parameters
    ----------
    values : array_like, shape (..., rows)
    period : float
        Control period, s.

    Returns
    -------
    ndarray, shape (...)
        NaN where the record is no longer than a stride.
    """
    values = np.asarray(values, dtype=float)
    taps = round(STRIDE / period)
    if values.shape[-1] <= taps or not np.isfinite(values).all():
        return np.full(values.shape[:-1], np.nan)
    means = np.apply_along_axis(np.convolve, -1, values, np.full(taps, 1.0 / taps), "valid")
    half = (taps - 1) // 2
    return rms(values[..., half : half + means.shape[-1]] - means)


def conflict_share(
    force_intent: ArrayLike, drive: ArrayLike, force_ripple: ArrayLike, drive_ripple: ArrayLike
) -> Score:
    """Return the share of rows in which human and drive push against each other.

    Both above their ripple, of opposite sign. Intended, not true force: true force and drive
    are the two reactions of one constraint, opposite whatever anybody wants.

    Parameters
    ----------
    force_intent : array_like, shape (..., rows)
        N, with the sign of the motion that it asks for.
    drive : array_like, shape (..., rows)
        Force or torque of the drive, N or N m; NaN where unknown.
    force_ripple, drive_ripple : array_like, shape (...)
        In the units of each.

    Returns
    -------
    Score
        Of shape (...).
    """
    force, drive = np.asarray(force_intent, dtype=float), np.asarray(drive, dtype=float)
    meant = np.abs(force) > np.asarray(force_ripple)[..., None]
    driven = np.abs(drive) > np.asarray(drive_ripple)[..., None]
    against = (meant & driven & (force * drive < 0.0)).astype(float)
    return mean_over_rows(np.where(np.isfinite(drive), against, np.nan))
