"""What walking together costs: effort, and forces that shake. Pure; rows come last."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array

SHAKING = (0.3, 1.0)
"""Band in which a robot shakes a person, Hz: faster than they change their mind, slower than
they step (model.md's choice; people's steps begin at 1.6 Hz, their sway at half of that)."""


def effort(force: ArrayLike, period: float) -> Array:
    """Return the integral of |F| over time, N s.

    Parameters
    ----------
    force : array_like, shape (..., rows)
        N.
    period : float
        Control period, s.

    Returns
    -------
    ndarray, shape (...)
    """
    return np.asarray(np.abs(force).sum(axis=-1) * period)


def squared_effort(force: ArrayLike, period: float) -> Array:
    """Return the integral of F^2 over time, N^2 s: hard pushes count more.

    Parameters
    ----------
    force, period
        See `effort`.

    Returns
    -------
    ndarray, shape (...)
    """
    return np.asarray(np.square(force).sum(axis=-1) * period)


def band_rms(force: ArrayLike, period: float, band: tuple[float, float] = SHAKING) -> Array:
    """Return the RMS of a force within a band of frequencies, both ends included, N.

    The mean and the straight line are taken off and a Hann window laid over what is left, so
    that neither a level nor where the run ends leaks into the band. A sine of amplitude a
    amid the band has a/sqrt(2).

    Parameters
    ----------
    force : array_like, shape (..., rows)
        N.
    period : float
        Control period, s.
    band : (float, float)
        Hz.

    Returns
    -------
    ndarray, shape (...)
        NaN where the record is shorter than two periods of the band's lower end.
    """
    force = np.asarray(force, dtype=float)
    rows = force.shape[-1]
    if rows * period < 2.0 / band[0]:
        return np.full(force.shape[:-1], np.nan)
    time = np.linspace(-1.0, 1.0, rows)
    left = force - force.mean(axis=-1, keepdims=True)
    slope = (left * time).sum(axis=-1, keepdims=True) / (time * time).sum()
    window = np.hanning(rows)
    spectrum = np.fft.rfft((left - slope * time) * window)
    frequency = np.fft.rfftfreq(rows, period)
    tiny = 1e-9
    within = (frequency >= band[0] - tiny) & (frequency <= band[1] + tiny)
    power = 2.0 * np.square(np.abs(spectrum[..., within])).sum(axis=-1)
    return np.asarray(np.sqrt(power / (rows * np.square(window).sum())))


def rms(values: ArrayLike) -> Array:
    """Return the root of the mean square of what is known, NaN where nothing is.

    Parameters
    ----------
    values : array_like, shape (..., rows)

    Returns
    -------
    ndarray, shape (...)
    """
    values = np.asarray(values, dtype=float)
    known = np.isfinite(values)
    count = known.sum(axis=-1)
    total = np.square(np.where(known, values, 0.0)).sum(axis=-1)
    return np.where(count > 0, np.sqrt(total / np.maximum(count, 1)), np.nan)
