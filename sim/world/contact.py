"""Which body touches what; and for a start at which the pair cannot stand, where it could."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .clearance import Distances
from .outline import Bodies
from .world import World

Pose = tuple[float, float, float]

STEP, STEPS = 0.05, 60
"""Of the search for a place that is free, m, and how many of them it goes."""
_AWAY = (1e6, 1e6, 0.0)


class Contact(NamedTuple):
    """A body and what it touches.

    Attributes
    ----------
    body : str
        Name of the body.
    thing : str
        Key of the thing in a scenario file, and its kind.
    depth : float
        How far one is inside the other, m.
    """

    body: str
    thing: str
    depth: float


def contact(
    world: World,
    bodies: Bodies,
    poses: tuple[Pose, ...],
    distances: Callable[[World], Distances],
    time: float = 0.0,
) -> Contact | None:
    """Return the deepest contact of a body with something solid, or None if there is none.

    Parameters
    ----------
    world, bodies, poses, distances
        See `blocked_start`.
    time : float
        Since reset, s.
    """
    deepest: Contact | None = None
    for thing, alone in _parts(world):
        measure = distances(alone)
        for number, name in enumerate(bodies.outlines):
            placed = [pose if n == number else _AWAY for n, pose in enumerate(poses)]
            clearance, touching = measure(time, *placed)
            if touching and (deepest is None or -clearance > deepest.depth):
                deepest = Contact(name, thing, -clearance)
        measure.close()
    return deepest


def blocked_start(
    world: World,
    bodies: Bodies,
    poses: tuple[Pose, ...],
    distances: Callable[[World], Distances],
) -> str:
    """Return which body touches what at the start, and where nearby the pair could stand.

    Parameters
    ----------
    world : World
    bodies : Bodies
    poses : tuple of (x, y, theta)
        Of the bodies at the world's start, in which something solid is touched.
    distances : callable
        Returns what measures distances in a world.
    """
    start = list(world.start)
    found = contact(world, bodies, poses, distances)
    said = "something solid is touched"
    if found is not None:
        said = f"the {found.body} is {found.depth:.2g} m inside {found.thing}"
    measure = distances(world)
    cure = _cure(world, bodies, poses, measure)
    measure.close()
    return f"world.start = {start}: {said}; {cure}"


def _parts(world: World) -> list[tuple[str, World]]:
    """Return every solid thing by its key, and a world with nothing else in it."""
    empty = World(world.path, start=world.start)
    found = []
    corridor = world.corridor
    if corridor is not None:
        # Doorways end at the corridor's walls, and side corridors open them.
        bare = replace(corridor, doorways=())
        found.append(
            (f"a wall of world.corridor (width = {bare.width:g})", replace(empty, corridor=bare))
        )
        found += [
            (
                f"world.corridor.doorways.{n}",
                replace(empty, corridor=replace(bare, doorways=(door,))),
            )
            for n, door in enumerate(corridor.doorways)
        ]
    found += [
        (f"world.walls.{n}", replace(empty, walls=(wall,))) for n, wall in enumerate(world.walls)
    ]
    found += [
        (f"world.obstacles.{n} ({thing.kind})", replace(empty, obstacles=(thing,)))
        for n, thing in enumerate(world.obstacles)
        if thing.solid
    ]
    found += [
        (f"world.furniture.{n} ({item.kind})", replace(empty, furniture=(item,)))
        for n, item in enumerate(world.furniture)
    ]
    found += [
        (f"world.pedestrians.{n}", replace(empty, pedestrians=(walker,)))
        for n, walker in enumerate(world.pedestrians)
    ]
    return found


def _cure(world: World, bodies: Bodies, poses: tuple[Pose, ...], measure: Distances) -> str:
    x, y, theta = world.start
    half = world.corridor.width / 2.0 if world.corridor else math.inf
    shifts = [
        (STEP * along, STEP * aside)
        for along in range(-STEPS, STEPS + 1)
        for aside in range(-STEPS, STEPS + 1)
        if along == 0 or aside == 0
    ]
    for dx, dy in sorted(shifts, key=lambda shift: abs(shift[0]) + abs(shift[1])):
        moved = [(px + dx, py + dy, yaw) for px, py, yaw in poses]
        if all(abs(py) < half for _, py, _ in moved) and not measure(0.0, *moved)[1]:
            free = [round(x + dx, 3), round(y + dy, 3), theta]
            return f"{free} would be free"
    outlines = bodies.outlines.values()
    corners = np.concatenate([o.at(pose) for o, pose in zip(outlines, poses, strict=True)])
    breadth = np.ptp(corners @ (-math.sin(theta), math.cos(theta)))
    return (
        f"nothing within {STEP * STEPS:g} m along x or y is free: "
        f"the {' and the '.join(bodies.outlines)} take {breadth:.2f} m across"
    )
