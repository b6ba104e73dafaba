"""The human's wish, read from the interaction force.

Schneider et al., arXiv 2407.17275, equations for the estimated change of movement.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array


def wish_change(
    force: ArrayLike,
    force_max: ArrayLike,
    force_threshold: ArrayLike,
    sensitivity: ArrayLike,
    upper: ArrayLike,
) -> Array:
    """Return the change of twist that a force asks for.

    sgn(F) min(|F|, F_max)/F_max * p_ub * f where |F| >= F_threshold, else 0. The paper prints
    the condition without the absolute value, which would ignore every push backwards or to
    the right; it is read as |F|.

    Parameters
    ----------
    force : array_like, shape (..., 2)
        Force of the human on the base ``[fx, fy]``, base axes, N.
    force_max, force_threshold : array_like, shape (..., 2)
        Cap and threshold, N.
    sensitivity : array_like, shape (..., 2)
        ``[f_v, f_omega]``, 1.
    upper : array_like, shape (..., 2)
        Upper bounds of the twist, m/s and rad/s.

    Returns
    -------
    ndarray, shape (..., 2)
        ``[dv, domega]`` in m/s and rad/s.
    """
    force = np.asarray(force, dtype=float)
    share = np.clip(force / force_max, -1.0, 1.0)
    asked = np.multiply(share, upper) * sensitivity
    return np.where(np.abs(force) >= force_threshold, asked, 0.0)


def human_wish(
    twist: ArrayLike,
    change: ArrayLike,
    lower: ArrayLike,
    upper: ArrayLike,
) -> Array:
    """Return the estimated wish: executed twist plus the change asked for, within the bounds.

    Parameters
    ----------
    twist, change, lower, upper : array_like, shape (..., 2)
        m/s and rad/s.

    Returns
    -------
    ndarray, shape (..., 2)
    """
    return np.clip(np.add(twist, change), lower, upper)
