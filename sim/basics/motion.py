"""Planar motion primitives: pure functions over arrays with leading batch axes.

A *twist* is a planar body twist ``[v, omega]`` in m/s and rad/s; held for a time it traces
a circular arc. A *pose* is ``[x, y, theta]`` in m, m, rad, world axes, counter-clockwise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .lists import require_entries
from .validators import Range, require

Array = NDArray[np.float64]
BOUND: Range = (-10.0, 10.0, "")
"""Of a twist, m/s and rad/s: what nobody can walk beside (inferred)."""
SLOWEST = 1e-6
"""Upper bound of a twist, m/s or rad/s, at which it moves at all (inferred)."""


def sinc(angle: ArrayLike) -> Array:
    """Return sin(a)/a, equal to 1 at a = 0 and smooth through it.

    Parameters
    ----------
    angle : array_like, shape (...)
        Angle in rad.

    Returns
    -------
    ndarray, shape (...)
    """
    angle = np.asarray(angle, dtype=float)
    apart = np.where(angle == 0.0, 1e-20, angle)
    return np.asarray(np.sin(apart) / apart)


def wrap_angle(angle: ArrayLike) -> Array:
    """Return the angle brought into [-pi, pi), in rad, shape (...)."""
    return (np.asarray(angle, dtype=float) + np.pi) % (2.0 * np.pi) - np.pi


def arc_displacement(twist: ArrayLike, duration: ArrayLike) -> Array:
    """Return the displacement along the arc of a constant twist, in the starting base frame.

    dx = vT sinc(wT), dy = vT (wT/2) sinc(wT/2)^2, dtheta = wT, exact for every w.

    Parameters
    ----------
    twist : array_like, shape (..., 2)
        ``[v, omega]`` in m/s and rad/s.
    duration : array_like, shape (...)
        Time T in s.

    Returns
    -------
    ndarray, shape (..., 3)
        ``[dx, dy, dtheta]`` in m, m, rad.
    """
    twist = np.asarray(twist, dtype=float)
    turn = np.multiply(twist[..., 1], duration)
    ahead, left = unit_arc(turn)
    length = twist[..., 0] * duration
    out = np.empty((*turn.shape, 3))
    out[..., 0], out[..., 1], out[..., 2] = length * ahead, length * left, turn
    return out


def unit_arc(turn: Array) -> tuple[Array, Array]:
    """Return where an arc of length 1 ends: ahead and to the left of its start.

    Parameters
    ----------
    turn : ndarray, shape (...)
        Angle wT through which the arc turns, rad.

    Returns
    -------
    (ndarray, ndarray), each of shape (...)
        sinc(wT) and (wT/2) sinc(wT/2)^2, both from the chord sinc(wT/2).
    """
    half = 0.5 * turn
    chord = sinc(half)
    return chord * np.cos(half), chord * chord * half


def compose(pose_world: ArrayLike, displacement_base: ArrayLike) -> Array:
    """Return the world pose reached by a displacement given in the base frame of a pose.

    Parameters
    ----------
    pose_world : array_like, shape (..., 3)
        ``[x, y, theta]`` in m, m, rad.
    displacement_base : array_like, shape (..., 3)
        ``[dx, dy, dtheta]`` in the axes of ``pose_world``.

    Returns
    -------
    ndarray, shape (..., 3)
        World pose; theta is not wrapped, so that it stays continuous over a run.
    """
    pose = np.asarray(pose_world, dtype=float)
    step = np.asarray(displacement_base, dtype=float)
    cos, sin = np.cos(pose[..., 2]), np.sin(pose[..., 2])
    return np.stack(
        np.broadcast_arrays(
            pose[..., 0] + cos * step[..., 0] - sin * step[..., 1],
            pose[..., 1] + sin * step[..., 0] + cos * step[..., 1],
            pose[..., 2] + step[..., 2],
        ),
        axis=-1,
    )


def world_to_base(pose_world: ArrayLike, points_world: ArrayLike) -> Array:
    """Return world points in the base frame of a pose.

    Parameters
    ----------
    pose_world : array_like, shape (..., 3)
    points_world : array_like, shape (..., 2)
        Points in m; leading axes broadcast against those of the pose.

    Returns
    -------
    ndarray, shape (..., 2)
    """
    pose = np.asarray(pose_world, dtype=float)
    offset = np.asarray(points_world, dtype=float) - pose[..., :2]
    cos, sin = np.cos(pose[..., 2]), np.sin(pose[..., 2])
    return np.stack(
        (
            cos * offset[..., 0] + sin * offset[..., 1],
            cos * offset[..., 1] - sin * offset[..., 0],
        ),
        axis=-1,
    )


@dataclass(frozen=True)
class TwistBounds:
    """Bounds on the twist: ``lower`` and ``upper`` are ``[v, omega]`` in m/s and rad/s.

    Raises
    ------
    InputError
        If they are not two numbers within `BOUND` each, a lower bound is not below its upper
        bound, or an upper bound is below `SLOWEST`.
    """

    lower: tuple[float, float] = (0.0, -0.5)
    upper: tuple[float, float] = (1.2, 0.5)

    def __post_init__(self) -> None:
        require_entries(self, ("lower", "upper"), 2, BOUND)
        for name, low, high in zip(("v", "omega"), self.lower, self.upper, strict=True):
            what = f"that of {name} must be {SLOWEST:g} or more, and above the lower, {low:g}"
            require(high >= SLOWEST and high > low, "upper", self.upper, what)
