"""How smoothly the base moves."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array

WINDOW = 0.5
"""Length of the Hann window that smooths a speed before it is differentiated, s (inferred): a
second difference of what was sampled says more of the rate than of the motion."""


def log_dimensionless_jerk(speed: ArrayLike, period: float, least_change: ArrayLike) -> Array:
    """Return the log dimensionless jerk of a speed: the less (more negative), the jerkier.

    -ln(T^3/v_peak^2 * integral of (d^2v/dt^2)^2 dt), of the speed smoothed by `WINDOW`
    (Hogan and Sternad 2009, 10.3200/35-09-004-RC; Balasubramanian et al. 2015,
    10.1186/s12984-015-0090-9). It grows with the duration T: compare runs of like length.

    Parameters
    ----------
    speed : array_like, shape (..., rows)
        v or omega, m/s or rad/s.
    period : float
        Control period, s.
    least_change : array_like, shape (...)
        Peak of |speed| below which nothing moved, in its units.

    Returns
    -------
    ndarray, shape (...)
        1; NaN where it did not change, or the record is shorter than four windows.
    """
    speed = np.asarray(speed, dtype=float)
    taps = max(3, round(WINDOW / period))
    rows = speed.shape[-1]
    if rows < 4 * taps:
        return np.full(speed.shape[:-1], np.nan)
    window = np.hanning(taps + 2)[1:-1]
    window /= window.sum()
    smooth = np.apply_along_axis(np.convolve, -1, speed, window, "valid")
    jerk = np.diff(smooth, 2, axis=-1) / period**2
    peak = np.abs(smooth).max(axis=-1)
    duration = smooth.shape[-1] * period
    with np.errstate(divide="ignore", invalid="ignore"):
        size = duration**3 / np.square(peak) * np.square(jerk).sum(axis=-1) * period
        return np.where(np.ptp(smooth, axis=-1) >= least_change, -np.log(size), np.nan)
