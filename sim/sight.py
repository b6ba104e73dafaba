"""Lines of sight on the floor plan: which points are hidden from an eye."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .motion import Array

Mask = NDArray[np.bool_]


def hidden_by_rectangles(eye: Array, points: Array, rectangles: Array) -> Mask:
    """Return which lines of sight pass through which rectangles.

    By the separating axis test of a segment and a rectangle; a line along an edge
    passes.

    Parameters
    ----------
    eye : ndarray, shape (2,)
        m.
    points : ndarray, shape (..., 2)
        What is looked at, m.
    rectangles : ndarray, shape (n, 6)
        ``[x, y, cos(yaw), sin(yaw), half_length, half_width]``, m.

    Returns
    -------
    ndarray of bool, shape (..., n)
    """
    x, y, cos, sin, half_length, half_width = rectangles.T
    eye_x, eye_y = eye[0] - x, eye[1] - y
    to_x, to_y = points[..., None, 0] - x, points[..., None, 1] - y
    middle_x, middle_y = (eye_x + to_x) / 2.0, (eye_y + to_y) / 2.0
    ray_x, ray_y = (to_x - eye_x) / 2.0, (to_y - eye_y) / 2.0
    along, across = cos * middle_x + sin * middle_y, cos * middle_y - sin * middle_x
    ray_along, ray_across = cos * ray_x + sin * ray_y, cos * ray_y - sin * ray_x
    passes = np.abs(along) >= half_length + np.abs(ray_along)
    passes |= np.abs(across) >= half_width + np.abs(ray_across)
    passes |= np.abs(along * ray_across - across * ray_along) > (
        half_length * np.abs(ray_across) + half_width * np.abs(ray_along)
    )
    return np.asarray(~passes)


def hidden_by_discs(eye: Array, points: Array, discs: Array) -> Mask:
    """Return which lines of sight pass through which discs.

    Parameters
    ----------
    eye : ndarray, shape (2,)
        m.
    points : ndarray, shape (..., 2)
        What is looked at, m.
    discs : ndarray, shape (n, 3)
        ``[x, y, radius]``, m.

    Returns
    -------
    ndarray of bool, shape (..., n)
    """
    ray = (points - eye)[..., None, :]
    centre = discs[:, :2] - eye
    length = np.maximum((ray**2).sum(axis=-1), 1e-12)
    share = np.clip((ray * centre).sum(axis=-1) / length, 0.0, 1.0)
    miss = share[..., None] * ray - centre
    return np.asarray((miss**2).sum(axis=-1) < discs[:, 2] ** 2)


def outline(eye: Array, discs: Array) -> Array:
    """Return the two points of each disc that stand out farthest from its line of sight.

    Parameters
    ----------
    eye : ndarray, shape (2,)
        m.
    discs : ndarray, shape (n, 3)
        ``[x, y, radius]``, m.

    Returns
    -------
    ndarray, shape (2, n, 2)
        The left and the right one, m.
    """
    ray = discs[:, :2] - eye
    length = np.maximum(np.hypot(ray[:, 0], ray[:, 1]), 1e-9)
    aside = np.stack((-ray[:, 1], ray[:, 0]), axis=-1) * (discs[:, 2] / length)[:, None]
    return discs[:, :2] + np.stack((aside, -aside))
