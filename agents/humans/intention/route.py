"""A path as a human follows it: their pose against it, and the point they aim at."""

from __future__ import annotations

import numpy as np

from cowalk.sim.basics.path import Path

from ...basics.elementwise import FLOATS, Elementwise, Value

Triple = tuple[Value, Value, Value]
"""x, y, theta in world axes, or station, offset, heading against a path: m, m, rad."""


class Route:
    """A `Path` for one human in plain floats, and for a batch.

    Parameters
    ----------
    path : Path

    Attributes
    ----------
    straight : bool
        Whether the path has a single segment, along which no pose in the world is asked for.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self.straight = len(path.points) == 2

    def relative(self, m: Elementwise, pose_world: Triple) -> Triple:
        """Return `Path.relative_pose`."""
        if m is FLOATS:
            return self._path.relative(*pose_world)
        found = self._path.relative_pose(_joined(pose_world))
        return found[..., 0], found[..., 1], found[..., 2]

    def absolute(self, m: Elementwise, relative: Triple) -> Triple:
        """Return `Path.absolute_pose`."""
        if m is FLOATS:
            return self._path.absolute(*relative)
        found = self._path.absolute_pose(_joined(relative))
        return found[..., 0], found[..., 1], found[..., 2]

    def towards(
        self,
        m: Elementwise,
        relative: Triple,
        pose_world: Triple,
        axis: tuple[Value, Value],
        lookahead: float,
        aim: Value,
    ) -> tuple[Value, Value]:
        """Return where the aimed point lies in base axes: ahead and to the left, m.

        Parameters
        ----------
        m : Elementwise
        relative : (station, offset, heading)
            Pose of the base against this path: m, m, rad.
        pose_world : (x, y, theta)
            The same pose in the world.
        axis : (float or ndarray, float or ndarray)
            Cosine and sine of the heading.
        lookahead : float
            Distance along the path at which they aim, m.
        aim : float or ndarray, shape (...)
            Offset from the path that they aim for, m.
        """
        station, offset, _ = relative
        cos, sin = axis
        if self.straight:
            dx, dy = lookahead, aim - offset
        else:
            x, y, theta = pose_world
            there_x, there_y, _ = self.absolute(m, (station + lookahead, aim, 0.0))
            dx, dy = there_x - x, there_y - y
            cos, sin = m.cos(theta), m.sin(theta)
        return cos * dx + sin * dy, cos * dy - sin * dx


def _joined(triple: Triple) -> np.ndarray:
    return np.stack(np.broadcast_arrays(*triple), axis=-1)
