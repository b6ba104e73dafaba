"""Stubbornness from force, and the concession it earns.

Schneider et al., arXiv 2407.17275: stubbornness per dimension, the interaction value, and the
utility loss that the automation accepts.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array


def stubbornness(
    force: ArrayLike,
    force_max: ArrayLike,
    wish_before: ArrayLike,
    twist: ArrayLike,
    lower: ArrayLike,
    upper: ArrayLike,
) -> Array:
    """Return the estimated stubbornness of each dimension.

    x = |F/F_max| * |(D - |p_H - p_A|) / D|, D = max(|p_H - p_ub|, |p_H - p_lb|), with |F/F_max|
    capped at 1. The paper's second assumption says that deviation raises stubbornness, yet
    this second factor lowers x as the executed twist deviates from the wish (its text explains
    that as compliance). The formula is implemented as printed.

    Parameters
    ----------
    force, force_max : array_like, shape (..., 2)
        Force of the human on the base, base axes, and its cap, N.
    wish_before : array_like, shape (..., 2)
        Estimated human wish of the negotiation before, m/s and rad/s.
    twist : array_like, shape (..., 2)
        Twist executed now, m/s and rad/s.
    lower, upper : array_like, shape (..., 2)
        Bounds of the twist, m/s and rad/s.

    Returns
    -------
    ndarray, shape (..., 2)
        In [0, 1] for a twist within the bounds.
    """
    insistence = np.minimum(np.abs(np.divide(force, force_max)), 1.0)
    reach = np.maximum(
        np.abs(np.subtract(wish_before, upper)), np.abs(np.subtract(wish_before, lower))
    )
    deviation = np.abs(np.subtract(wish_before, twist))
    return np.asarray(insistence * np.abs((reach - deviation) / reach))


def interaction_value(stubbornness_norm: ArrayLike, utility_loss_before: ArrayLike) -> Array:
    """Return I = -2 + 3 ||x|| + U_loss, in [-2, 2].

    The paper computes U_loss from I in the same step, an algebraic loop; the loss of the step
    before is used.

    Parameters
    ----------
    stubbornness_norm : array_like, shape (...)
        Norm of the stubbornness, in [0, 1] (`stubbornness_norm`).
    utility_loss_before : array_like, shape (...)
        Utility loss of the step before, in [0, 1].
    """
    return np.add(-2.0 + 3.0 * np.asarray(stubbornness_norm), utility_loss_before)


def stubbornness_norm(values: ArrayLike) -> Array:
    """Return the Euclidean norm over the negotiated dimensions, capped at 1.

    ||x|| = min(1, sqrt(sum x^2)). One dimension alone is exactly the paper's, and whoever is
    fully stubborn in one of two is conceded everything. Without the cap two dimensions reach
    sqrt(2), and the interaction value would exceed the maximum of 2 that the paper states.

    Parameters
    ----------
    values : array_like, shape (..., n)
        Stubbornness of the n negotiated dimensions, each in [0, 1].

    Returns
    -------
    ndarray, shape (...)
        In [0, 1].
    """
    values = np.asarray(values, dtype=float)
    return np.asarray(np.minimum(np.linalg.norm(values, axis=-1), 1.0))


def utility_loss(
    interaction_smoothed: ArrayLike, interaction_min: ArrayLike, interaction_max: ArrayLike
) -> Array:
    """Return U_loss = (I - I_min)/(I_max - I_min), clipped to [0, 1].

    Parameters
    ----------
    interaction_smoothed : array_like, shape (...)
        Smoothed interaction value.
    interaction_min, interaction_max : array_like, shape (...)
        Values at which the automation concedes nothing, and everything.

    Returns
    -------
    ndarray, shape (...)
    """
    span = np.subtract(interaction_max, interaction_min)
    return np.clip(np.subtract(interaction_smoothed, interaction_min) / span, 0.0, 1.0)
