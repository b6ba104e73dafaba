"""Where things appear in a picture: a pinhole or level camera as two matrices. Pure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..basics.motion import Array


@dataclass(frozen=True, eq=False)
class Camera:
    """A camera of OpenGL's convention: it looks along its own -z, and x is right in the picture.

    Attributes
    ----------
    view : ndarray, shape (4, 4)
        World to camera axes, homogeneous.
    projection : ndarray, shape (4, 4)
        Camera axes to clip space, homogeneous.
    width, height : int
        Size of the picture in pixels.
    """

    view: Array
    projection: Array
    width: int
    height: int

    def project(self, points: ArrayLike) -> Array:
        """Return where points of the world appear.

        Parameters
        ----------
        points : array_like, shape (..., 3)
            World axes, m.

        Returns
        -------
        ndarray, shape (..., 2)
            Pixels to the right and down from the picture's upper left corner; NaN where a point
            is not in front of the camera.
        """
        place = np.asarray(points, dtype=np.float64)
        matrix = self.projection @ self.view
        clip = place @ matrix[:, :3].T + matrix[:, 3]
        depth = np.where(clip[..., 3:] > 1e-6, clip[..., 3:], np.nan)
        right, up = np.moveaxis(clip[..., :2] / depth, -1, 0)
        return np.stack(((right + 1.0) / 2.0 * self.width, (1.0 - up) / 2.0 * self.height), axis=-1)


def level_camera(
    across: tuple[float, float], along: tuple[float, float], width: int, height: int
) -> Camera:
    """Return a camera that sees a rectangle of the ground from straight above, undistorted.

    Parameters
    ----------
    across, along : (float, float)
        World x at the picture's left and right edge, and world y at its bottom and top, m.
    width, height : int
        Size of the picture in pixels.
    """
    projection = np.eye(4)
    for axis, (low, high) in enumerate((across, along)):
        projection[axis, axis] = 2.0 / (high - low)
        projection[axis, 3] = -(high + low) / (high - low)
    return Camera(np.eye(4), projection, width, height)
