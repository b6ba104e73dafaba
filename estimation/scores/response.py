"""How an estimate answers a step of the truth.

For stubbornness: the disagreement is held at 0.3 of the bound, s stepped between 0.2 and 0.6.
Judge both directions: a constant misses at least one.
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

RISEN = 0.63
"""Share of the step at which a response counts as risen."""
HELD = 0.5
"""Time for which it must stay there, s."""


def rise_time(responses: ArrayLike, before: float, after: float, period: float) -> float:
    """Return when the mean response over people has passed 63 % of the step, and stays 0.5 s.

    Parameters
    ----------
    responses : array_like, shape (..., rows)
        Estimates from the step on (the first row is that of the step), averaged over the
        leading axes.
    before, after : float
        The truth before and after the step. The share is that of the true step: an estimate
        that hardly moves is not quick.
    period : float
        Sampling period, s.

    Returns
    -------
    float
        s; infinite where the response never gets there, or was there before it was asked.

    Raises
    ------
    InputError
        If the truth makes no step.
    """
    there = np.asarray(_progress(responses, before, after) >= RISEN)
    window = max(1, round(HELD / period)) + 1
    if there.size <= window:
        return float("inf")
    stays = np.asarray(sliding_window_view(there, window).all(axis=-1))
    passes = stays[1:] & ~there[: stays.size - 1]
    return float((1 + np.argmax(passes)) * period) if passes.any() else float("inf")


def overshoot(responses: ArrayLike, before: float, after: float) -> float:
    """Return by how much the mean response over people goes beyond the truth, at most.

    max over rows of (x - after)/(after - before), at least 0: a share of the step.

    Parameters
    ----------
    responses, before, after
        See `rise_time`.

    Raises
    ------
    InputError
        If the truth makes no step.
    """
    return max(0.0, float(np.max(_progress(responses, before, after))) - 1.0)


def _progress(responses: ArrayLike, before: float, after: float) -> Array:
    """Return the mean response as a share of the step, shape (rows,)."""
    if before == after:
        raise InputError(f"before = after = {after}: the truth must make a step")
    responses = np.asarray(responses, dtype=float)
    mean = responses.reshape(-1, responses.shape[-1]).mean(axis=0)
    return np.asarray((mean - before) / (after - before))
