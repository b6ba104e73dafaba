"""Frames in space: a rotation and an origin, one within another. Pure."""

from __future__ import annotations

import math

import numpy as np

from .motion import Array

Vector = tuple[float, float, float]
Frame = tuple[Array, Array]
"""Rotation (3, 3) and origin (3,), m."""
GRAVITY = 9.81
"""m/s^2."""


def within(outer: Frame, inner: Frame) -> Frame:
    """Return a frame that is given in the axes of an outer one, in what that is given in."""
    (turn, shift), (own_turn, own_shift) = outer, inner
    return turn @ own_turn, shift + turn @ own_shift


def rotation(roll: float, pitch: float, yaw: float) -> Array:
    """Return the rotation matrix of fixed-axis roll, pitch, yaw (rad), shape (3, 3)."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def about(axis: Vector, angle: float) -> Array:
    """Return the rotation matrix of a turn about an axis, shape (3, 3), by Rodrigues' formula.

    Parameters
    ----------
    axis : (x, y, z)
        Of length 1.
    angle : float
        rad.
    """
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turned = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (cross @ cross)
    return np.asarray(turned)


def roll_pitch_yaw(turn: Array) -> Vector:
    """Return the fixed-axis angles of a rotation matrix (3, 3), rad: the inverse of `rotation`.

    Where the pitch is a right angle, only the sum or difference of the others counts: yaw is 0.
    """
    level = math.hypot(turn[0, 0], turn[1, 0])
    pitch = math.atan2(-turn[2, 0], level)
    if level < 1e-9:
        return math.atan2(-turn[1, 2], turn[1, 1]), pitch, 0.0
    return math.atan2(turn[2, 1], turn[2, 2]), pitch, math.atan2(turn[1, 0], turn[0, 0])
