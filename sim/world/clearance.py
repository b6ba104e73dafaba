"""Distances from round bodies to everything in a world, in closed form."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, Protocol

from ..basics.errors import InputError
from .footprint import furniture, walls
from .heights import WALL_HEIGHT
from .outline import Outline
from .world import World

Disc = tuple[float, float, float]
"""Centre and radius, m."""
Box = tuple[float, float, float, float, float, float]
"""Centre, cosine and sine of its yaw, half length and half width, m."""


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


class _Part(NamedTuple):
    """A disc, or a capsule: all that is no farther than its radius from its core, a segment."""

    number: int
    x: float
    y: float
    half_x: float
    half_y: float
    radius: float
    marks: tuple[Disc, ...]
    """What is not lower than its underside, of what lies on the floor; then of what is solid."""
    discs: tuple[Disc, ...]
    boxes: tuple[Box, ...]


class Clearance:
    """Signed distance from discs and capsules to discs and rectangles, set up once, then cheap.

    Plain floats, and nothing is measured exactly that is farther away than what was found
    already: up to some twenty things this beats array operations (``python -m benchmarks``).

    Parameters
    ----------
    world : World
    parts : sequence of (int, Outline)
        See `Bodies.parts`: what is measured, and the number of the pose that it goes with.

    Raises
    ------
    InputError
        If an outline is neither a disc nor a capsule.
    """

    def __init__(self, world: World, parts: Sequence[tuple[int, Outline]]) -> None:
        self._pedestrians = world.pedestrians
        marks, discs = (
            [((o.x, o.y, o.radius), o.top) for o in world.obstacles if o.solid is solid]
            for solid in (False, True)
        )
        standing = [(wall, WALL_HEIGHT) for wall in walls(world)]
        standing += [(furniture(item), item.top) for item in world.furniture]
        boxes = [
            ((b.x, b.y, math.cos(b.yaw), math.sin(b.yaw), b.half_length, b.half_width), top)
            for b, top in standing
        ]
        self._parts = []
        for number, outline in parts:
            low = outline.underside
            self._parts.append(
                _Part(
                    number,
                    *_core(outline),
                    tuple(thing for thing, top in marks if top >= low),
                    tuple(thing for thing, top in discs if top >= low),
                    tuple(box for box, top in boxes if top >= low),
                )
            )

    def close(self) -> None:
        """See `Distances.close`: nothing is held."""

    def __call__(self, time: float, *poses: tuple[float, float, float]) -> tuple[float, bool]:
        """See `Distances`."""
        walking: tuple[Disc, ...] = ()
        if self._pedestrians:
            states = [(p.state(time), p.radius) for p in self._pedestrians]
            walking = tuple((state[0], state[1], radius) for state, radius in states)
        marked = solid = math.inf
        for number, x, y, half_x, half_y, radius, marks, discs, boxes in self._parts:
            at_x, at_y, yaw = poses[number]
            nearest = solid + radius
            if half_x == half_y == x == y == 0.0:
                marked = min(marked, _to_discs(marks, at_x, at_y, math.inf) - radius)
                nearest = _to_discs(discs + walking, at_x, at_y, nearest)
                solid = min(solid, _to_boxes(boxes, at_x, at_y, nearest) - radius)
                continue
            cos, sin = math.cos(yaw), math.sin(yaw)
            core = (
                at_x + cos * x - sin * y,
                at_y + sin * x + cos * y,
                cos * half_x - sin * half_y,
                sin * half_x + cos * half_y,
            )
            marked = min(marked, _core_to_discs(marks, core, math.inf) - radius)
            nearest = _core_to_discs(discs + walking, core, nearest)
            solid = min(solid, _core_to_boxes(boxes, core, nearest) - radius)
        return min(marked, solid), solid < 0.0


def _core(outline: Outline) -> tuple[float, float, float, float, float]:
    """Return centre, half of the segment, and radius of a disc or a capsule, m."""
    first, *others = outline.discs
    if len(others) > 1 or any(other[2] != first[2] for other in others):
        raise InputError(
            f"an outline of {len(outline.discs)} discs is neither a disc nor a capsule: "
            "its distances are known to the plant 'bullet' alone"
        )
    last = others[0] if others else first
    middle = (first[0] + last[0]) / 2.0, (first[1] + last[1]) / 2.0
    return *middle, (last[0] - first[0]) / 2.0, (last[1] - first[1]) / 2.0, first[2]


def _to_discs(discs: tuple[Disc, ...], x: float, y: float, nearest: float) -> float:
    """Return the signed distance of a point to the nearest disc, or ``nearest`` if less."""
    for centre_x, centre_y, radius in discs:
        gap = ((x - centre_x) ** 2 + (y - centre_y) ** 2) ** 0.5 - radius
        if gap < nearest:
            nearest = gap
    return nearest


def _to_boxes(boxes: tuple[Box, ...], x: float, y: float, nearest: float) -> float:
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


Core = tuple[float, float, float, float]
"""Centre of a segment, and the way from it to its end, m."""


def _core_to_discs(discs: tuple[Disc, ...], core: Core, nearest: float) -> float:
    """Return the signed distance of a segment to the nearest disc, or ``nearest`` if less."""
    x, y, half_x, half_y = core
    square = half_x * half_x + half_y * half_y
    for centre_x, centre_y, radius in discs:
        dx, dy = centre_x - x, centre_y - y
        share = min(max((dx * half_x + dy * half_y) / square, -1.0), 1.0) if square else 0.0
        dx -= share * half_x
        dy -= share * half_y
        gap = (dx * dx + dy * dy) ** 0.5 - radius
        if gap < nearest:
            nearest = gap
    return nearest


def _core_to_boxes(boxes: tuple[Box, ...], core: Core, nearest: float) -> float:
    """Return the signed distance of a segment to the nearest box, or ``nearest`` if less."""
    x, y, half_x, half_y = core
    for centre_x, centre_y, cos, sin, half_length, half_width in boxes:
        dx, dy = x - centre_x, y - centre_y
        along, across = cos * dx + sin * dy, cos * dy - sin * dx
        way_along, way_across = cos * half_x + sin * half_y, cos * half_y - sin * half_x
        # Between the two on each of the three axes that can part them; the box's first.
        gap_along = abs(along) - half_length - abs(way_along)
        if gap_along >= nearest:
            continue
        gap_across = abs(across) - half_width - abs(way_across)
        if gap_across >= nearest:
            continue
        length = (way_along * way_along + way_across * way_across) ** 0.5
        gap_beside = -math.inf
        if length > 0.0:
            gap_beside = (
                abs(along * way_across - across * way_along)
                - half_length * abs(way_across)
                - half_width * abs(way_along)
            ) / length
        parted = max(gap_along, gap_across, gap_beside)
        if parted < 0.0:
            nearest = min(nearest, parted)
            continue
        ends = ((along + way_along, across + way_across), (along - way_along, across - way_across))
        for end_along, end_across in ends:
            out_along = max(abs(end_along) - half_length, 0.0)
            out_across = max(abs(end_across) - half_width, 0.0)
            nearest = min(nearest, (out_along * out_along + out_across * out_across) ** 0.5)
        square = length * length
        for corner_along in (half_length, -half_length):
            for corner_across in (half_width, -half_width):
                to_along, to_across = corner_along - along, corner_across - across
                if square:
                    share = (to_along * way_along + to_across * way_across) / square
                    share = min(max(share, -1.0), 1.0)
                    to_along -= share * way_along
                    to_across -= share * way_across
                nearest = min(nearest, (to_along * to_along + to_across * to_across) ** 0.5)
    return nearest
