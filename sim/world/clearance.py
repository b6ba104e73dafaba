"""Distances from round bodies to everything in a world, in closed form."""

from __future__ import annotations

import math
from typing import Protocol

from .footprint import furniture, walls
from .world import World


class Distances(Protocol):
    """What a plant measures distances with."""

    def __call__(self, time: float, *poses: tuple[float, float, float]) -> tuple[float, bool]:
        """Return the clearance to anything, m, and whether something solid is touched.

        Parameters
        ----------
        time : float
            Since reset, s: pedestrians have moved on.
        *poses : (x, y, theta)
            World pose of each body: m, m, rad.

        Returns
        -------
        (float, bool)
            The distance of the body that is nearest to anything: negative inside something,
            infinite where there is nothing.
        """
        ...

    def close(self) -> None:
        """Free what it holds. May be called twice; the plant's `close` does it too."""
        ...


class Clearance:
    """Signed distance from discs to discs and rectangles, set up once and then cheap.

    Plain floats, and nothing is measured exactly that is farther away than what was found
    already: up to some twenty things this beats array operations (``python -m benchmarks``).

    Parameters
    ----------
    world : World
    radii : sequence of float
        Radius in m of each body (base, human), in the order in which calls get them.
    """

    def __init__(self, world: World, radii: tuple[float, ...]) -> None:
        self._radii = radii
        self._marks = tuple((o.x, o.y, o.radius) for o in world.obstacles if not o.solid)
        self._discs = tuple((o.x, o.y, o.radius) for o in world.obstacles if o.solid)
        self._pedestrians = world.pedestrians
        boxes = (*walls(world), *map(furniture, world.furniture))
        self._boxes = tuple(
            (b.x, b.y, math.cos(b.yaw), math.sin(b.yaw), b.half_length, b.half_width) for b in boxes
        )

    def close(self) -> None:
        """See `Distances.close`: nothing is held."""

    def __call__(self, time: float, *poses: tuple[float, float, float]) -> tuple[float, bool]:
        """See `Distances`."""
        discs = self._discs
        if self._pedestrians:
            walking = [(p.state(time), p.radius) for p in self._pedestrians]
            discs += tuple((state[0], state[1], radius) for state, radius in walking)
        marked = solid = math.inf
        for radius, (x, y, _) in zip(self._radii, poses, strict=True):
            marked = min(marked, _to_discs(self._marks, x, y, math.inf) - radius)
            nearest = _to_discs(discs, x, y, solid + radius)
            solid = min(solid, _to_boxes(self._boxes, x, y, nearest) - radius)
        return min(marked, solid), solid < 0.0


def _to_discs(
    discs: tuple[tuple[float, float, float], ...], x: float, y: float, nearest: float
) -> float:
    """Return the signed distance of a point to the nearest disc, or ``nearest`` if less."""
    for centre_x, centre_y, radius in discs:
        gap = ((x - centre_x) ** 2 + (y - centre_y) ** 2) ** 0.5 - radius
        if gap < nearest:
            nearest = gap
    return nearest


def _to_boxes(
    boxes: tuple[tuple[float, float, float, float, float, float], ...],
    x: float,
    y: float,
    nearest: float,
) -> float:
    """Return the signed distance of a point to the nearest box, or ``nearest`` if less."""
    for centre_x, centre_y, cos, sin, half_length, half_width in boxes:
        dx, dy = x - centre_x, y - centre_y
        along = abs(cos * dx + sin * dy) - half_length
        if along >= nearest:
            continue
        across = abs(cos * dy - sin * dx) - half_width
        if across >= nearest:
            continue
        if along > 0.0 and across > 0.0:
            gap = (along * along + across * across) ** 0.5
            if gap < nearest:
                nearest = gap
        else:
            nearest = along if along > across else across
    return nearest
