"""Force and torque, and the frame in which a mounted sensor reports them. Pure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .motion import Array
from .urdf import rotation


@dataclass(frozen=True)
class SensorMount:
    """Where and how the force-torque sensor sits.

    Parameters
    ----------
    position : (x, y, z)
        Origin of the sensor's frame from the handle, base axes, m.
    rpy : (roll, pitch, yaw)
        Its attitude, fixed-axis angles in rad: what turns base axes into sensor axes.
    """

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0)


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
        Force and torque about the sensor's origin, sensor axes.
    """
    turn = rotation(*mount.rpy)
    force, torque = wrench[..., :3], wrench[..., 3:]
    moved = torque - np.cross(np.asarray(mount.position), force)
    return np.concatenate((force @ turn, moved @ turn), axis=-1)
