"""The oracle: a Bayes filter over stubbornness that is told the wish and the delay.

It knows what no observer does, p_H(t) and the person's reaction time, and else hears the same:
force behind the entry's front end, with its noise. It is not told s, nor the person's kappa and
F_max unless asked for; of those it knows how they are spread over people. It is a reference,
not a bound: its model of how s moves is generic.

It is written here since `filterpy.discrete_bayes` does not fit a bounded range: its ``predict``
wraps around by default (who insists fully may next let go), in its other mode mass is lost at
the ends, and its ``update`` normalises along one axis, while strength and stubbornness are joint.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from .references import GRID

_TRACE = 0.01
"""Weight that is spread over all values, so that what nobody else did is not impossible."""


def oracle(
    force: ArrayLike,
    wish: ArrayLike,
    twist_before: ArrayLike,
    upper: float,
    *,
    prior: ArrayLike,
    gain: ArrayLike,
    force_max: ArrayLike,
    noise: float,
    period: float,
    delay: float = 0.0,
    walk: float = 0.1,
    renewal: float = 0.05,
) -> Array:
    """Return what the filter believes of s in each row: one dimension of one run.

    F_k = F_max sat(kappa s_j (p_H,j - p_(j-1))/p_ub) + noise, j = k - delay. s walks at random
    between 0 and 1, reflected at the ends, and now and then is drawn anew from the prior, to
    which the filter so returns while it hears nothing.

    Parameters
    ----------
    force : array_like, shape (rows,)
        Measured, behind the front end, N; NaN where nothing was heard.
    wish : array_like, shape (rows,)
        p_H, m/s or rad/s; NaN where there is none.
    twist_before : array_like, shape (rows,)
        p_(k-1), m/s or rad/s (`row_before`).
    upper : float
        p_ub, m/s or rad/s.
    prior : array_like, shape (51,)
        Probability of each value of s on 0, 0.02, ... 1 in other people (`Prior.weights`).
    gain, force_max : array_like, shape (m,)
        m pairs of kappa (1) and F_max (N) that the person may have, equally likely. An oracle
        that is told kappa F_max gets pairs with that product.
    noise : float
        Standard deviation of the force behind the front end, N.
    period : float
        Control period, s.
    delay : float
        The person's reaction time, s; rounded to whole periods.
    walk : float
        Standard deviation of the random walk after one second, 1. Inferred.
    renewal : float
        How often s is drawn anew, 1/s. Inferred.

    Returns
    -------
    ndarray, shape (rows, 51)
        Probabilities, after hearing that row's force; see `grid_moments` and `crps_discrete`.

    Raises
    ------
    InputError
        If a value makes no sense.
    """
    _require(period=(period, True), noise=(noise, True), upper=(upper, True))
    _require(delay=(delay, False), walk=(walk, False), renewal=(renewal, False))
    gain, strongest = np.asarray(gain, dtype=float), np.asarray(force_max, dtype=float)
    if gain.ndim != 1 or gain.shape != strongest.shape or gain.size == 0:
        raise InputError("gain, force_max: as many of one as of the other are expected")
    start = _start(np.asarray(prior, dtype=float))
    force = np.asarray(force, dtype=float)
    missing = np.subtract(wish, twist_before) / upper
    late = min(round(delay / period), force.size)
    felt = np.concatenate((np.full(late, np.nan), missing[: force.size - late]))
    transition = _transition(start, walk * np.sqrt(period), renewal * period)
    # From the row that a force answers to, on to the row in which it is heard.
    ahead = np.linalg.matrix_power(transition, late)
    joint = np.tile(start / gain.size, (gain.size, 1))
    beliefs = np.empty((force.size, GRID.size))
    for k in range(force.size):
        if k > 0:
            joint = joint @ transition
        if np.isfinite(force[k]) and np.isfinite(felt[k]):
            share = np.clip(gain[:, None] * felt[k] * GRID, -1.0, 1.0)
            off = ((force[k] - strongest[:, None] * share) / noise) ** 2
            # The best explanation counts as 1, so that they do not all underflow.
            joint = joint * np.exp(-0.5 * (off - off.min()))
            joint = joint / joint.sum()
        beliefs[k] = joint.sum(axis=0) @ ahead
    return beliefs


def grid_moments(weights: ArrayLike) -> tuple[Array, Array]:
    """Return mean and standard deviation of beliefs over 0, 0.02, ... 1.

    Parameters
    ----------
    weights : array_like, shape (..., 51)

    Returns
    -------
    (ndarray, ndarray), each of shape (...)
    """
    weights = np.asarray(weights, dtype=float)
    mean = np.asarray(weights @ GRID)
    return mean, np.sqrt(np.maximum(weights @ GRID**2 - mean**2, 0.0))


def _require(**given: tuple[float, bool]) -> None:
    for name, (value, positive) in given.items():
        if not (0.0 < value < np.inf or (value == 0.0 and not positive)):
            least = "above" if positive else "at least"
            raise InputError(f"{name} = {value}: must be {least} 0", (name,))


def _start(prior: Array) -> Array:
    if prior.shape != GRID.shape or np.any(prior < 0.0) or not prior.sum() > 0.0:
        raise InputError(f"prior: {GRID.size} probabilities are expected, not all 0", ("prior",))
    return np.asarray((1.0 - _TRACE) * prior / prior.sum() + _TRACE / GRID.size)


def _transition(start: Array, spread: float, renewals: float) -> Array:
    """Return the probability of going from a value (row) to another (column) in one period."""
    # A chain whose steps go to a neighbour or stay: its variance is right however small it is.
    variance = (spread / GRID[1]) ** 2
    steps = max(1, int(np.ceil(variance)))
    half = 0.5 * variance / steps
    once = np.diag(np.full(GRID.size, 1.0 - 2.0 * half))
    once += half * (np.eye(GRID.size, k=1) + np.eye(GRID.size, k=-1))
    once[0, 0] += half
    once[-1, -1] += half  # reflected
    anew = -np.expm1(-renewals)
    return np.asarray((1.0 - anew) * np.linalg.matrix_power(once, steps) + anew * start)
