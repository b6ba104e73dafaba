"""Paths in the world plane: where the pair is to walk, and a pose seen relative to it."""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from .lists import require_rows
from .motion import Array, wrap_angle
from .validators import Range, refusal

PLACE: Range = (-1e5, 1e5, "m")
"""Where things may be, m: nobody walks farther in a day (inferred)."""


@dataclass(frozen=True)
class Path:
    """A polyline in the world plane, extended straight beyond both of its ends.

    Parameters
    ----------
    points : sequence of (x, y)
        At least two distinct consecutive points in m.

    Raises
    ------
    InputError
        If there are fewer than two points, one is not two numbers within `PLACE`, or two
        consecutive ones coincide.
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
        need = "a path needs at least two points (x, y)"
        require_rows(self, "points", (PLACE, PLACE), 2, need)
        points = np.asarray(self.points, dtype=float)
        legs = np.diff(points, axis=0)
        lengths = np.hypot(legs[:, 0], legs[:, 1])
        if not np.all(lengths > 0.0):
            raise refusal("points", self.points, "two consecutive points of a path coincide")
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
