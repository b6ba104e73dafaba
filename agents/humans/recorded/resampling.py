"""Forces of a recording at the control rate. Pure."""

from __future__ import annotations

from typing import Literal

import numpy as np

from cowalk.sim.basics.motion import Array


def resample(
    time: Array, force: Array, period: float, how: Literal["mean", "linear", "hold"]
) -> Array:
    """Return one force for each control period of a recording.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s from 0, rising.
    force : ndarray, shape (n, 2)
        N.
    period : float
        Control period, s.
    how : {"mean", "linear", "hold"}
        Mean over the period (nothing above the control rate's half aliases into it), value
        between the two nearest samples at its start, or the last sample before it.

    Returns
    -------
    ndarray, shape (floor(time[-1]/period), 2)
        At least one row.
    """
    count = max(1, int(time[-1] / period + 1e-9))
    starts = np.arange(count + 1) * period
    if how == "hold":
        at = np.searchsorted(time, starts[:-1] + 1e-9, side="right") - 1
        return np.asarray(force[at])
    if how == "linear":
        return np.stack([np.interp(starts[:-1], time, part) for part in force.T], axis=-1)
    # Slow to import, and needed only here.
    from scipy.interpolate import make_interp_spline

    area = make_interp_spline(time, force, k=1).antiderivative()
    ends = np.minimum(starts, time[-1])
    return np.asarray(np.diff(area(ends), axis=0) / np.diff(ends)[:, None])
