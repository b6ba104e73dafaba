"""How well an estimate follows the truth: error, bias and lag."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array


def rmse(estimate: ArrayLike, truth: ArrayLike) -> float:
    """Return the root-mean-square error over all finite samples, in the units of the signals.

    Parameters
    ----------
    estimate, truth : array_like, shape (n,)

    Returns
    -------
    float
        NaN if no pair of samples is finite.
    """
    error = _errors(estimate, truth)
    return float(np.sqrt(np.mean(error**2))) if error.size else float("nan")


def bias(estimate: ArrayLike, truth: ArrayLike) -> float:
    """Return the mean error, estimate minus truth, over all finite samples."""
    error = _errors(estimate, truth)
    return float(np.mean(error)) if error.size else float("nan")


def lag(estimate: ArrayLike, truth: ArrayLike, period: float, longest: float = 10.0) -> float:
    """Return the delay of an estimate behind the truth: the peak of their cross-correlation.

    Parameters
    ----------
    estimate, truth : array_like, shape (n,)
        Finite samples at a constant rate.
    period : float
        Sampling period, s.
    longest : float
        Longest delay looked for, either way, s.

    Returns
    -------
    float
        Delay in s, positive if the estimate comes later; NaN if either signal is constant.
    """
    a, b = np.asarray(estimate, dtype=float), np.asarray(truth, dtype=float)
    known = np.isfinite(a) & np.isfinite(b)
    a, b = a[known], b[known]
    if a.size < 2 or np.ptp(a) < 1e-12 or np.ptp(b) < 1e-12:
        return float("nan")
    a, b = a - a.mean(), b - b.mean()
    delays = np.arange(1 - a.size, a.size)
    delays = delays[np.abs(delays) * period <= longest]
    correlation = np.correlate(np.pad(a, delays[-1]), b, "valid")
    return float(delays[np.argmax(correlation)] * period)


def _errors(estimate: ArrayLike, truth: ArrayLike) -> Array:
    error = np.asarray(estimate, dtype=float) - np.asarray(truth, dtype=float)
    return np.asarray(error[np.isfinite(error)])
