"""Differential drive: a twist as wheel speeds and back, and limits that keep the curve. Pure."""

from __future__ import annotations

from typing import TypeVar

from ..basics.motion import Array

Value = TypeVar("Value", float, Array)


def wheel_speeds(v: Value, omega: Value, track: float, radius: float) -> tuple[Value, Value]:
    """Return the angular speeds of the left and the right wheel, rad/s.

    Parameters
    ----------
    v, omega : float or ndarray, shape (...)
        m/s and rad/s.
    track : float
        Distance of the wheels, m.
    radius : float
        Of the wheels, m.

    Returns
    -------
    (left, right)
        (v -/+ omega track / 2) / radius.
    """
    turn = omega * track / 2.0
    return (v - turn) / radius, (v + turn) / radius


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
