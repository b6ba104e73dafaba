"""By how much an estimate comes after the truth."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

ALIKE = 0.5
"""Least correlation at the peak: below it an estimate does not follow the truth at any delay."""
_TINY = 1e-9


def lag(estimate: ArrayLike, truth: ArrayLike, period: float, longest: float = 10.0) -> float:
    """Return the delay at which an estimate is most like the truth, by cross-correlation.

    argmax over d of r(d) = <a, b>/(|a| |b|), where a is estimate(t + d) and b is truth(t) over
    the time in which both are known, each without its mean and its straight line there. So
    neither levels and trends nor where a signal starts and ends pull at it, and gain and
    offset of the estimate do not count. (A straight line that comes late is the same line with
    an offset: there is nothing to be read from it.)

    Parameters
    ----------
    estimate, truth : array_like, shape (rows,)
        Samples at a constant rate; NaN where unknown.
    period : float
        Sampling period, s.
    longest : float
        Longest delay looked for, either way, s; at most a quarter of the signals, since less
        and less that overlaps looks more and more alike.

    Returns
    -------
    float
        Delay in s, a whole number of periods, positive if the estimate comes later. Of delays
        that fit equally well, as with a period, the shortest. NaN where there is none to read:
        a signal is constant or a straight line, no delay has r(d) of at least 0.5, or r(d)
        still rises at the end of what is looked for.

    Raises
    ------
    InputError
        If the signals are not of one length, or the period is not above 0.
    """
    a, b = np.asarray(estimate, dtype=float), np.asarray(truth, dtype=float)
    if a.ndim != 1 or a.shape != b.shape:
        raise InputError(f"shapes {a.shape} and {b.shape}: two signals of one length are expected")
    if not period > 0.0:
        raise InputError(f"period = {period}: must be above 0 s", ("period",))
    if not (_moves(a) and _moves(b)):
        return float("nan")
    furthest = min(round(longest / period), a.size // 4)
    delays = np.arange(-furthest, furthest + 1)
    alike = np.array([_correlation(a, b, int(delay)) for delay in delays])
    peak = alike.max(initial=-1.0)
    best = delays[alike >= peak - _TINY]
    if peak < ALIKE or best.size == 0:
        return float("nan")
    shortest = int(best[np.argmin(np.abs(best))])
    return float("nan") if abs(shortest) == furthest > 0 else shortest * period


def _moves(values: Array) -> bool:
    """Return whether a signal is more than a straight line, in which no delay can be read."""
    time = np.flatnonzero(np.isfinite(values))
    return time.size >= 3 and _without_line(values[time], time)[1] > 0.0


def _correlation(a: Array, b: Array, delay: int) -> float:
    """Return r(d), -1 where a signal has nothing but a straight line in the overlap."""
    a = a[max(delay, 0) : a.size + min(delay, 0)]
    b = b[max(-delay, 0) : b.size - max(delay, 0)]
    time = np.flatnonzero(np.isfinite(a) & np.isfinite(b))
    if time.size < 3:
        return -1.0
    a, left_a = _without_line(a[time], time)
    b, left_b = _without_line(b[time], time)
    return float(a @ b / np.sqrt(left_a * left_b)) if left_a > 0.0 < left_b else -1.0


def _without_line(values: Array, time: NDArray[np.intp]) -> tuple[Array, float]:
    """Return a signal without its straight line, and its energy; 0 if that is rounding."""
    # Against the values themselves: of a constant, the mean taken off leaves rounding alone.
    least = _TINY**2 * float(values @ values)
    values, since = values - values.mean(), time - time.mean()
    left = values - since * (since @ values / (since @ since))
    energy = float(left @ left)
    return left, energy if energy > least else 0.0
