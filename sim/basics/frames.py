"""Frames in space: a rotation and an origin, one within another. Pure."""

from __future__ import annotations

import math

import numpy as np

from .motion import Array

Vector = tuple[float, float, float]
Frame = tuple[Array, Array]
"""Rotation (3, 3) and origin (3,), m."""


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
