"""What a seat sees of the world from where its eye is."""

from __future__ import annotations

import math

import numpy as np

from .footprint import WALL_THICKNESS, Rectangle, cross_wall, furniture, walls
from .motion import Array, world_to_base
from .observation import OBSTACLE_COLUMNS, OBSTACLE_ROWS
from .sight import Mask, hidden_by_discs, hidden_by_rectangles, outline
from .world import World

NOTHING = -1
"""Number of the occluder that a thing is, for things that hide nothing."""


class Eyes:
    """The obstacles that a seat perceives: seen by it, in range, and not hidden.

    A thing is seen as soon as its middle or either side of its outline is. Walls, furniture,
    solid obstacles and pedestrians hide what is behind them. Furniture is perceived as discs in
    a row that cover it, a doorway as a thin disc at either post, a wall as one at either end.

    Parameters
    ----------
    world : World
    seat : str
        ``"human"``, who sees from the head, or ``"automation"``, from a sensor in front.
    front : float
        How far ahead of the base's centre that sensor is, m.
    """

    def __init__(self, world: World, seat: str, front: float = 0.0) -> None:
        self._human = seat == "human"
        self._front = front
        self._range = getattr(world.view_range, seat)
        boxes = [*walls(world), *map(furniture, world.furniture)]
        pillars = [(o.x, o.y, o.radius) for o in world.obstacles if o.solid]
        things: list[tuple[float, float, float]] = []
        own: list[tuple[int, int]] = []  # which rectangle and which disc a thing itself is
        for obstacle in world.obstacles:
            disc = (obstacle.x, obstacle.y, obstacle.radius)
            if seat in obstacle.seen_by:
                things.append(disc)
                own.append((NOTHING, pillars.index(disc) if obstacle.solid else NOTHING))
        for item in world.furniture:
            if seat in item.seen_by:
                box = furniture(item)
                covers = covering_discs(box)
                things += covers
                own += [(boxes.index(box), NOTHING)] * len(covers)
        for box, disc in wall_ends(world):
            things.append(disc)
            own.append((boxes.index(box), NOTHING))
        walkers = world.pedestrians
        self._walking_discs = len(pillars)
        self._walkers = walkers
        self._seen_walkers = [n for n, walker in enumerate(walkers) if seat in walker.seen_by]
        for number in self._seen_walkers:
            walker = walkers[number]
            things.append((*walker.waypoints[0], walker.radius))
            own.append((NOTHING, len(pillars) + number))
        self._things = np.array(things, dtype=float).reshape(-1, 3)
        self._velocity = np.zeros((len(things), 2))
        self._moving = len(things) - len(self._seen_walkers)
        own_rectangle, own_disc = np.array(own, dtype=int).reshape(-1, 2).T
        self._discs = np.array(
            [*pillars, *((*w.waypoints[0], w.radius) for w in walkers)], dtype=float
        ).reshape(-1, 3)
        if _all_inside(world, things):
            boxes = boxes[len(walls(world)) :]
            own_rectangle = own_rectangle - len(walls(world))
        self._rectangles = np.array(
            [
                (b.x, b.y, math.cos(b.yaw), math.sin(b.yaw), b.half_length, b.half_width)
                for b in boxes
            ]
        ).reshape(-1, 6)
        self._not_itself_rectangle = own_rectangle[:, None] != np.arange(len(self._rectangles))
        self._not_itself_disc = own_disc[:, None] != np.arange(len(self._discs))
        self._hiding = bool(len(self._rectangles) or len(self._discs))

    def look(
        self,
        base_pose: tuple[float, float, float],
        human_pose: tuple[float, float, float],
        time: float,
    ) -> Array:
        """Return the ``obstacles`` of an `Observation`, shape (8, 6).

        Parameters
        ----------
        base_pose, human_pose : (x, y, theta)
            World axes, m and rad.
        time : float
            Since reset, s.
        """
        rows = np.zeros((OBSTACLE_ROWS, OBSTACLE_COLUMNS))
        things, velocity = self._things, self._velocity
        if not len(things):
            return rows
        if self._walkers:
            self._walk(time)
        centres = world_to_base(np.array(base_pose), things[:, :2])
        gap = np.hypot(centres[:, 0], centres[:, 1]) - things[:, 2]
        order = np.argsort(gap, kind="stable")
        if self._hiding or self._range < math.inf:
            order = order[self._visible(base_pose, human_pose)[order]]
        order = order[:OBSTACLE_ROWS]
        n = len(order)
        rows[:n, 0] = 1.0
        rows[:n, 1:3] = centres[order]
        rows[:n, 3] = things[order, 2]
        if self._seen_walkers:
            turned = world_to_base(np.array((0.0, 0.0, base_pose[2])), velocity[order])
            rows[:n, 4:6] = turned
        return rows

    def _walk(self, time: float) -> None:
        states = np.array([walker.state(time) for walker in self._walkers])
        self._discs[self._walking_discs :, :2] = states[:, :2]
        if self._seen_walkers:
            seen = states[self._seen_walkers]
            self._things[self._moving :, :2] = seen[:, :2]
            self._velocity[self._moving :] = seen[:, 2:]

    def _visible(
        self, base_pose: tuple[float, float, float], human_pose: tuple[float, float, float]
    ) -> Mask:
        if self._human:
            eye = np.array(human_pose[:2])
        else:
            x, y, theta = base_pose
            eye = np.array((x + self._front * math.cos(theta), y + self._front * math.sin(theta)))
        things = self._things
        visible = np.ones(len(things), dtype=bool)
        if self._range < math.inf:
            away = things[:, :2] - eye
            visible = np.hypot(away[:, 0], away[:, 1]) - things[:, 2] <= self._range
        if self._hiding:
            hidden = self._hidden(eye, things[:, :2])
            if hidden.any():
                for side in outline(eye, things):
                    hidden &= self._hidden(eye, side)
            visible &= ~hidden
        return visible

    def _hidden(self, eye: Array, points: Array) -> Mask:
        hidden = np.zeros(len(points), dtype=bool)
        if len(self._rectangles):
            through = hidden_by_rectangles(eye, points, self._rectangles)
            hidden |= (through & self._not_itself_rectangle).any(axis=-1)
        if len(self._discs):
            through = hidden_by_discs(eye, points, self._discs)
            hidden |= (through & self._not_itself_disc).any(axis=-1)
        return hidden


def covering_discs(box: Rectangle) -> list[tuple[float, float, float]]:
    """Return discs in a row, as few as there are squares in it, that cover a rectangle, m."""
    x, y, length, width, yaw = box
    if width > length:
        length, width, yaw = width, length, yaw + math.pi / 2.0
    count = math.ceil(length / width - 1e-9)
    half = length / count
    radius = math.hypot(half, width)
    places = [half * (2 * number + 1) - length for number in range(count)]
    return [(x + at * math.cos(yaw), y + at * math.sin(yaw), radius) for at in places]


def wall_ends(world: World) -> list[tuple[Rectangle, tuple[float, float, float]]]:
    """Return the posts of doorways and the ends of free walls: the wall they end, and a disc."""
    found = []
    thick = WALL_THICKNESS / 2.0
    if world.corridor is not None:
        for door in world.corridor.doorways:
            for box in cross_wall(world.corridor, door.x, door.y, door.width):
                side = math.copysign(door.width / 2.0 + thick, box.y - door.y)
                found.append((box, (door.x, door.y + side, thick)))
    for wall, box in zip(world.walls, walls(world), strict=False):
        found += [(box, (*end, wall.thickness / 2.0)) for end in (wall.start, wall.end)]
    return found


def _all_inside(world: World, things: list[tuple[float, float, float]]) -> bool:
    """Return whether walls can hide nothing: everything is in one straight corridor."""
    corridor = world.corridor
    if world.walls or corridor is None or corridor.doorways or corridor.side_corridors:
        return False
    places = [(x, y) for x, y, _ in things]
    places += [point for walker in world.pedestrians for point in walker.waypoints]
    return all(abs(y) < corridor.width / 2.0 for _, y in places)
