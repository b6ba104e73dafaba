"""Differential drive: a twist as wheel speeds and back, and limits that keep the curve. Pure."""

from __future__ import annotations

import numpy as np

from ..basics.motion import Array


def wheel_speeds(twist: Array, track: float, radius: float) -> Array:
    """Return the angular speeds of the left and the right wheel, rad/s.

    Parameters
    ----------
    twist : ndarray, shape (..., 2)
        v in m/s and omega in rad/s.
    track : float
        Distance of the wheels, m.
    radius : float
        Of the wheels, m.

    Returns
    -------
    ndarray, shape (..., 2)
        (v -/+ omega track / 2) / radius.
    """
    v, omega = twist[..., 0], twist[..., 1]
    turn = omega * track / 2.0
    return np.stack((v - turn, v + turn), axis=-1) / radius


def twist_of(speeds: Array, track: float, radius: float) -> Array:
    """Return the twist, shape (..., 2), of wheel speeds (left, right) in rad/s."""
    left, right = speeds[..., 0] * radius, speeds[..., 1] * radius
    return np.stack(((left + right) / 2.0, (right - left) / track), axis=-1)


def limited(
    twist: tuple[float, float], max_speed: float, max_rate: float, track: float, max_rim: float
) -> tuple[float, float]:
    """Return the twist, scaled so that it keeps to every limit: slower, on the same curve.

    Parameters
    ----------
    twist : (v, omega)
        m/s and rad/s.
    max_speed, max_rate : float
        Of the base, m/s and rad/s.
    track : float
        Distance of the wheels, m.
    max_rim : float
        Largest speed of a wheel's rim, m/s.
    """
    v, omega = twist
    excess = max(
        abs(v) / max_speed,
        abs(omega) / max_rate,
        (abs(v) + abs(omega) * track / 2.0) / max_rim,
    )
    return (v / excess, omega / excess) if excess > 1.0 else (v, omega)
