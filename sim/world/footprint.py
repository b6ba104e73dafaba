"""Rectangles on the floor plan: what walls and furniture occupy."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..basics.motion import Array
from .world import Corridor, Furniture, SideCorridor, Wall, World

WALL_THICKNESS = 0.1
"""Of a corridor's walls, m; they stand outside its clear width."""
REACH = 50.0
"""How far a corridor's walls go on beyond everything that is given a place, m."""


class Rectangle(NamedTuple):
    """A rectangle in the world plane.

    Attributes
    ----------
    x, y : float
        Centre, m.
    half_length, half_width : float
        Half of its sides, m.
    yaw : float
        Direction of the length, rad.
    """

    x: float
    y: float
    half_length: float
    half_width: float
    yaw: float = 0.0


def corners(box: Rectangle) -> Array:
    """Return the corners of a rectangle, counter-clockwise, shape (4, 2), m."""
    signs = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    cos, sin = math.cos(box.yaw), math.sin(box.yaw)
    turn = np.array([[cos, sin], [-sin, cos]])
    return np.asarray(signs * (box.half_length, box.half_width) @ turn + (box.x, box.y))


def pieces(box: Rectangle, length: float) -> list[Rectangle]:
    """Return a rectangle cut along its length, or an upright one along y, no piece longer (m)."""
    x, y, half_length, half_width, yaw = box
    upright = half_width > half_length
    half = half_width if upright else half_length
    count = math.ceil(2.0 * half / length)
    part = half / count
    turn = yaw + (math.pi / 2.0 if upright else 0.0)
    sizes = (half_length, part) if upright else (part, half_width)
    places = [part * (2 * number + 1) - half for number in range(count)]
    return [
        Rectangle(x + at * math.cos(turn), y + at * math.sin(turn), *sizes, yaw) for at in places
    ]


def walls(world: World, reach: float = REACH) -> tuple[Rectangle, ...]:
    """Return the walls of a world.

    Parameters
    ----------
    world : World
    reach : float
        How far a corridor's walls go on beyond path, start and openings, m.
    """
    found = [_wall(wall) for wall in world.walls]
    if world.corridor is not None:
        for door in world.corridor.doorways:
            found += cross_wall(world.corridor, door.x, door.y, door.width)
    return (*found, *outer_walls(world, reach))


def outer_walls(world: World, reach: float = REACH) -> tuple[Rectangle, ...]:
    """Return those of the walls that bound the corridor and what branches off."""
    corridor = world.corridor
    if corridor is None:
        return ()
    places = [point[0] for point in world.path.points]
    places.append(world.start[0])
    places += [door.x for door in corridor.doorways]
    places += [side.x for side in corridor.side_corridors]
    return tuple(_side_walls(corridor, min(places) - reach, max(places) + reach))


def wall_ends(world: World) -> list[tuple[Rectangle, tuple[float, float, float]]]:
    """Return the posts of doorways and the ends of free walls: the wall, and a disc at its end."""
    found = []
    thick = WALL_THICKNESS / 2.0
    for wall in world.walls:
        box = _wall(wall)
        found += [(box, (*end, wall.thickness / 2.0)) for end in (wall.start, wall.end)]
    if world.corridor is not None:
        for door in world.corridor.doorways:
            for box in cross_wall(world.corridor, door.x, door.y, door.width):
                side = math.copysign(door.width / 2.0 + thick, box.y - door.y)
                found.append((box, (door.x, door.y + side, thick)))
    return found


def furniture(item: Furniture) -> Rectangle:
    """Return what a piece of furniture occupies."""
    return Rectangle(item.x, item.y, item.length / 2.0, item.width / 2.0, item.yaw)


def cross_wall(corridor: Corridor, x: float, y: float, width: float) -> list[Rectangle]:
    """Return the pieces of a wall across a corridor beside an opening around y, right one first."""
    half = corridor.width / 2.0
    pieces = ((-half, y - width / 2.0), (y + width / 2.0, half))
    return [
        Rectangle(x, (low + high) / 2.0, WALL_THICKNESS / 2.0, (high - low) / 2.0)
        for low, high in pieces
        if high > low
    ]


def _wall(wall: Wall) -> Rectangle:
    (x, y), (to_x, to_y) = wall.start, wall.end
    return Rectangle(
        (x + to_x) / 2.0,
        (y + to_y) / 2.0,
        math.hypot(to_x - x, to_y - y) / 2.0,
        wall.thickness / 2.0,
        math.atan2(to_y - y, to_x - x),
    )


def _side_walls(corridor: Corridor, left: float, right: float) -> list[Rectangle]:
    half, thick = corridor.width / 2.0, WALL_THICKNESS / 2.0
    found = []
    for side, sign in (("left", 1.0), ("right", -1.0)):
        openings = sorted(
            (branch for branch in corridor.side_corridors if branch.side == side),
            key=lambda branch: branch.x,
        )
        begin = left
        for branch in openings:
            end = branch.x - branch.width / 2.0
            found.append(_along_x(begin, end, sign * (half + thick)))
            begin = branch.x + branch.width / 2.0
            found += _branch(branch, sign, half)
        found.append(_along_x(begin, right, sign * (half + thick)))
    return found


def _along_x(begin: float, end: float, y: float) -> Rectangle:
    return Rectangle((begin + end) / 2.0, y, (end - begin) / 2.0, WALL_THICKNESS / 2.0)


def _branch(branch: SideCorridor, sign: float, half: float) -> list[Rectangle]:
    """Return the two walls and the end of a side corridor."""
    thick = WALL_THICKNESS / 2.0
    # Its walls begin where the corridor's end, so that no two stand in one place.
    begin, end = half + 2.0 * thick, half + branch.length
    out = branch.width / 2.0 + thick
    found = [_along_x(branch.x - out - thick, branch.x + out + thick, sign * (end + thick))]
    if end > begin:
        found += [
            Rectangle(branch.x + at, sign * (begin + end) / 2.0, thick, (end - begin) / 2.0)
            for at in (-out, out)
        ]
    return found
