"""Planar motion primitives and paths: pure functions over arrays with leading batch axes.

A *twist* is a planar body twist ``[v, omega]`` in m/s and rad/s; held for a time it traces
a circular arc. A *pose* is ``[x, y, theta]`` in m, m, rad, world axes, counter-clockwise.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


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
    return np.sinc(np.asarray(angle, dtype=float) / np.pi)


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
    ValueError
        If a lower bound is not below its upper bound, or an upper bound is not positive.
    """

    lower: tuple[float, float] = (0.0, -0.5)
    upper: tuple[float, float] = (1.2, 0.5)

    def __post_init__(self) -> None:
        for name, low, high in zip(("v", "omega"), self.lower, self.upper, strict=True):
            if not low < high or not high > 0.0:
                raise ValueError(
                    f"twist bounds of {name} are [{low}, {high}]; "
                    "the lower must lie below the upper, and the upper above 0"
                )


@dataclass(frozen=True)
class Path:
    """A polyline in the world plane, extended straight beyond both of its ends.

    Parameters
    ----------
    points : sequence of (x, y)
        At least two distinct consecutive points in m.

    Raises
    ------
    ValueError
        If there are fewer than two points or two consecutive ones coincide.
    """

    points: tuple[tuple[float, float], ...]
    _start: Array = field(init=False, repr=False, compare=False)
    _direction: Array = field(init=False, repr=False, compare=False)
    _angle: Array = field(init=False, repr=False, compare=False)
    _station: Array = field(init=False, repr=False, compare=False)
    _low: Array = field(init=False, repr=False, compare=False)
    _high: Array = field(init=False, repr=False, compare=False)
    _legs: tuple[tuple[float, ...], ...] = field(init=False, repr=False, compare=False)
    _turns: list[float] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        points = np.asarray(self.points, dtype=float)
        if points.ndim != 2 or points.shape[-1] != 2 or len(points) < 2:
            raise ValueError(f"a path needs at least two points (x, y), got shape {points.shape}")
        legs = np.diff(points, axis=0)
        lengths = np.hypot(legs[:, 0], legs[:, 1])
        if not np.all(lengths > 0.0):
            raise ValueError("two consecutive points of a path coincide")
        low = np.zeros(len(legs))
        low[0] = -np.inf
        high = lengths.copy()
        high[-1] = np.inf
        for name, value in (
            ("_start", points[:-1]),
            ("_direction", legs / lengths[:, None]),
            ("_angle", np.arctan2(legs[:, 1], legs[:, 0])),
            ("_station", np.concatenate(([0.0], np.cumsum(lengths)))),
            ("_low", low),
            ("_high", high),
        ):
            object.__setattr__(self, name, value)
        columns = (low, high, *points[:-1].T, *self._direction.T, self._station[:-1], self._angle)
        legs_in_floats = tuple(zip(*(column.tolist() for column in columns), strict=True))
        object.__setattr__(self, "_legs", legs_in_floats)
        object.__setattr__(self, "_turns", self._station[1:-1].tolist())

    @property
    def length(self) -> float:
        """Length from the first to the last point in m."""
        return float(self._station[-1])

    def relative_pose(self, pose_world: ArrayLike) -> Array:
        """Return the pose relative to the path: ``[station, offset, heading]``.

        Parameters
        ----------
        pose_world : array_like, shape (..., 3)

        Returns
        -------
        ndarray, shape (..., 3)
            Distance along the path of the nearest path point (m), distance from it (m, positive
            to the left) and heading against the path's direction there (rad, in [-pi, pi)).
        """
        pose = np.asarray(pose_world, dtype=float)
        offset = pose[..., None, :2] - self._start
        direction = self._direction
        along = offset[..., 0] * direction[:, 0] + offset[..., 1] * direction[:, 1]
        across = direction[:, 0] * offset[..., 1] - direction[:, 1] * offset[..., 0]
        if len(direction) == 1:
            return np.stack(
                (along[..., 0], across[..., 0], wrap_angle(pose[..., 2] - self._angle[0])), axis=-1
            )
        distance = np.hypot(along - np.clip(along, self._low, self._high), across)
        nearest = np.argmin(distance, axis=-1)
        pick = nearest[..., None]
        on_leg = np.take_along_axis(along, pick, axis=-1)[..., 0]
        on_leg = np.clip(on_leg, self._low[nearest], self._high[nearest])
        return np.stack(
            (
                self._station[nearest] + on_leg,
                np.take_along_axis(np.copysign(distance, across), pick, axis=-1)[..., 0],
                wrap_angle(pose[..., 2] - self._angle[nearest]),
            ),
            axis=-1,
        )

    def relative(self, x: float, y: float, theta: float) -> tuple[float, float, float]:
        """Return `relative_pose` of one pose in plain floats: ten times faster in a step."""
        nearest = math.inf
        for low, high, start_x, start_y, ux, uy, begins, angle in self._legs:
            dx, dy = x - start_x, y - start_y
            along, across = dx * ux + dy * uy, ux * dy - uy * dx
            within = min(max(along, low), high)
            distance = math.hypot(along - within, across)
            if distance < nearest:
                nearest = distance
                found = begins + within, math.copysign(distance, across), angle
        station, offset, direction = found
        return station, offset, (theta - direction + math.pi) % (2.0 * math.pi) - math.pi

    def absolute(self, station: float, offset: float, heading: float) -> tuple[float, float, float]:
        """Return `absolute_pose` of one pose in plain floats, as `relative` is for its inverse."""
        leg = bisect_right(self._turns, station)
        _, _, start_x, start_y, ux, uy, begins, angle = self._legs[leg]
        along = station - begins
        return (
            start_x + along * ux - offset * uy,
            start_y + along * uy + offset * ux,
            angle + heading,
        )

    def point_at(self, station: ArrayLike) -> Array:
        """Return the path point at a distance along the path.

        Parameters
        ----------
        station : array_like, shape (...)
            Distance from the first point in m; outside [0, length] on the straight extension.

        Returns
        -------
        ndarray, shape (..., 2)
        """
        station = np.asarray(station, dtype=float)
        leg = np.searchsorted(self._station[1:-1], station, side="right")
        along = (station - self._station[leg])[..., None]
        return np.asarray(self._start[leg] + along * self._direction[leg])

    def absolute_pose(self, relative_pose: ArrayLike) -> Array:
        """Return the world pose of a pose given relative to the path.

        Parameters
        ----------
        relative_pose : array_like, shape (..., 3)
            ``[station, offset, heading]`` as from `relative_pose`.

        Returns
        -------
        ndarray, shape (..., 3)
            Theta is the path's direction plus the heading, in rad, not wrapped.
        """
        relative = np.asarray(relative_pose, dtype=float)
        leg = np.searchsorted(self._station[1:-1], relative[..., 0], side="right")
        direction = self._direction[leg]
        foot = self.point_at(relative[..., 0])
        return np.stack(
            (
                foot[..., 0] - direction[..., 1] * relative[..., 1],
                foot[..., 1] + direction[..., 0] * relative[..., 1],
                self._angle[leg] + relative[..., 2],
            ),
            axis=-1,
        )
