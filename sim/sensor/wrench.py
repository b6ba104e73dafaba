"""Force and torque, and the frame in which a mounted sensor reports them. Pure."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..basics.frames import rotation
from ..basics.lists import require_entries
from ..basics.motion import Array
from ..basics.validators import Range, require

FARTHEST = 2.0
"""Of a sensor from the handle, m: beyond the size of what two people walk with (inferred)."""
TURN: Range = (-10.0, 10.0, "rad")
"""Of its attitude: more than a turn either way (inferred)."""


@dataclass(frozen=True)
class SensorMount:
    """Where and how the force-torque sensor sits.

    Parameters
    ----------
    position : (x, y, z)
        Origin of the sensor's frame from the handle, base axes, m.
    rpy : (roll, pitch, yaw)
        Its attitude, fixed-axis angles in rad: what turns base axes into sensor axes.

    Raises
    ------
    InputError
        If it is not three numbers each, farther from the handle than `FARTHEST`, or an angle
        outside of `TURN`.
    """

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        require_entries(self, ("position",), 3, (-math.inf, math.inf, "m"))
        require_entries(self, ("rpy",), 3, TURN)
        what = f"must lie within {FARTHEST:g} m of the handle"
        require(math.hypot(*self.position) <= FARTHEST, "position", self.position, what)

    # Read in every control step, so worked out once.

    @cached_property
    def at_handle(self) -> bool:
        """Whether the sensor's frame is the base's, moved to the handle."""
        return not (any(self.position) or any(self.rpy))

    @cached_property
    def to_sensor(self) -> Array:
        """What `in_sensor_frame` multiplies a row (F, M) with, shape (6, 6)."""
        turn = rotation(*self.rpy)
        return np.block([[turn, _cross(self.position) @ turn], [np.zeros((3, 3)), turn]])

    @cached_property
    def to_base(self) -> Array:
        """Its inverse, which `in_base_frame` multiplies with, shape (6, 6)."""
        back = rotation(*self.rpy).T
        return np.block([[back, -back @ _cross(self.position)], [np.zeros((3, 3)), back]])


AT_HANDLE = SensorMount()
"""A sensor whose frame is the base's, moved to the handle."""


def in_sensor_frame(wrench: Array, mount: SensorMount) -> Array:
    """Return a wrench about the handle as the sensor sees it.

    F_s = R^T F, M_s = R^T (M - p x F), with R the attitude and p the position of the mount.

    Parameters
    ----------
    wrench : ndarray, shape (..., 6)
        Force (N) and torque about the handle (N m), base axes.
    mount : SensorMount

    Returns
    -------
    ndarray, shape (..., 6)
        Force and torque about the sensor's origin, sensor axes; the very input for a sensor
        whose frame is the base's, moved to the handle.
    """
    return wrench if mount.at_handle else wrench.dot(mount.to_sensor)


def in_base_frame(wrench: Array, mount: SensorMount) -> Array:
    """Return a wrench that the sensor reads as it acts about the handle.

    F = R F_s, M = R M_s + p x F: the inverse of `in_sensor_frame`.

    Parameters
    ----------
    wrench : ndarray, shape (..., 6)
        Force (N) and torque about the sensor's origin (N m), sensor axes.
    mount : SensorMount

    Returns
    -------
    ndarray, shape (..., 6)
        Force and torque about the handle, base axes; the very input for a sensor whose frame
        is the base's, moved to the handle.
    """
    return wrench if mount.at_handle else wrench.dot(mount.to_base)


def _cross(position: tuple[float, float, float]) -> Array:
    """Return [p]x, so that [p]x F = p x F; a row F times it is F x p."""
    x, y, z = position
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
