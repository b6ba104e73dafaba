"""What a seat sees of the world from where its eye is."""

from __future__ import annotations

import math
from bisect import bisect_right
from typing import TypeVar

import numpy as np

from ..basics.motion import Array
from ..basics.observation import OBSTACLE_COLUMNS, OBSTACLE_ROWS
from .footprint import Rectangle, furniture, outer_walls, wall_ends, walls
from .heights import PEDESTRIAN_HEIGHT, WALL_HEIGHT
from .sight import Pillar, Point, Screen, behind_pillar, behind_screen
from .world import World

NOTHING = -1
"""Number of the occluder that a thing is which hides nothing."""

Occluder = TypeVar("Occluder", Pillar, Screen)
Pose = tuple[float, float, float]
Disc = tuple[float, float, float]
Thing = tuple[float, float, float, float, int, float, float]
"""``(x, y, radius, height, number of the occluder that it is, vx, vy)``, m and m/s."""


class Eyes:
    """The obstacles that a seat perceives: seen by it, in range, and not hidden.

    A thing is seen as soon as its upper end is, in the middle or on either side. Walls, furniture,
    solid obstacles and pedestrians hide what is behind them up to a line over their own upper
    edge. Furniture is perceived as discs in
    a row that cover it, a doorway as a thin disc at either post, a wall as one at either end.

    Parameters
    ----------
    world : World
    seat : str
        ``"human"``, who sees from the head, or ``"automation"``, from a camera on the base.
    eye : (x, y, z)
        Where that is, axes of trunk or base, m.
    """

    def __init__(self, world: World, seat: str, eye: Point) -> None:
        self._human, self._eye = seat == "human", eye
        self._range: float = getattr(world.view_range, seat)
        self._things: list[Thing] = []
        self._pillars: list[Pillar] = []
        numbers: dict[Rectangle, int] = {}
        heights: dict[Rectangle, float] = {}
        boxes = [(furniture(item), item.top) for item in world.furniture]
        for box, height in (*((wall, WALL_HEIGHT) for wall in walls(world)), *boxes):
            numbers.setdefault(box, len(numbers))
            heights[box] = max(height, heights.get(box, 0.0))
        screens = {
            box: Screen(
                number,
                box.x,
                box.y,
                math.cos(box.yaw),
                math.sin(box.yaw),
                box.half_length,
                box.half_width,
                heights[box],
            )
            for box, number in numbers.items()
        }
        # Between two places in a straight corridor nothing of its own walls can stand.
        self._half_width = world.corridor.width / 2.0 if world.corridor else 0.0
        outer = set(outer_walls(world))
        self._screens = list(screens.values())
        self._inner = [screen for box, screen in screens.items() if box not in outer]
        count = len(numbers)
        for obstacle in world.obstacles:
            place, top = (obstacle.x, obstacle.y, obstacle.radius), obstacle.top
            if obstacle.solid:
                self._pillars.append(Pillar(count + len(self._pillars), *place, top))
            if seat in obstacle.seen_by:
                self._add([place], top, self._pillars[-1].number if obstacle.solid else NOTHING)
        for item in world.furniture:
            if seat in item.seen_by:
                self._add(covering_discs(furniture(item)), item.top, numbers[furniture(item)])
        for box, place in wall_ends(world):
            self._add([place], WALL_HEIGHT, numbers[box])
        count += len(self._pillars)
        self._walkers = [
            (walker, count + number, seat in walker.seen_by)
            for number, walker in enumerate(world.pedestrians)
        ]

    def _add(self, discs: list[Disc], height: float, number: int) -> None:
        self._things += [(*disc, height, number, 0.0, 0.0) for disc in discs]

    def look(self, base_pose: Pose, human_pose: Pose, time: float) -> Array:
        """Return the ``obstacles`` of an `Observation`, shape (8, 6).

        Parameters
        ----------
        base_pose, human_pose : (x, y, theta)
            World axes, m and rad.
        time : float
            Since reset, s.
        """
        rows = np.zeros((OBSTACLE_ROWS, OBSTACLE_COLUMNS))
        things, pillars = self._things, self._pillars
        if self._walkers:
            things, pillars = self._with_walkers(time)
        if not things:
            return rows
        x, y, theta = base_pose
        cos, sin = math.cos(theta), math.sin(theta)
        eye = _placed(self._eye, human_pose if self._human else base_pose)
        # Nearest first: what begins farther away than a thing ends cannot hide it.
        near_pillars = _by_distance(eye, [(p.x, p.y, p.radius, p) for p in pillars])
        near_screens = _by_distance(
            eye, [(s.x, s.y, s.half_length + s.half_width, s) for s in self._inner]
        )
        near = [(math.hypot(t[0] - x, t[1] - y) - t[2], n) for n, t in enumerate(things)]
        near.sort()
        found = []
        for _, n in near:
            thing = things[n]
            if self._sees(eye, thing, near_pillars, near_screens):
                dx, dy, vx, vy = thing[0] - x, thing[1] - y, thing[5], thing[6]
                place = (cos * dx + sin * dy, cos * dy - sin * dx, thing[2])
                found.append((1.0, *place, cos * vx + sin * vy, cos * vy - sin * vx))
                if len(found) == OBSTACLE_ROWS:
                    break
        if found:
            rows[: len(found)] = found
        return rows

    def _with_walkers(self, time: float) -> tuple[list[Thing], list[Pillar]]:
        things, pillars = self._things.copy(), self._pillars.copy()
        for walker, number, seen in self._walkers:
            x, y, vx, vy = walker.state(time)
            pillars.append(Pillar(number, x, y, walker.radius, PEDESTRIAN_HEIGHT))
            if seen:
                things.append((x, y, walker.radius, PEDESTRIAN_HEIGHT, number, vx, vy))
        return things, pillars

    def _sees(
        self,
        eye: Point,
        thing: Thing,
        near_pillars: tuple[list[float], list[Pillar]],
        near_screens: tuple[list[float], list[Screen]],
    ) -> bool:
        x, y, radius, height, number, _, _ = thing
        ray_x, ray_y = x - eye[0], y - eye[1]
        away = math.hypot(ray_x, ray_y)
        if away - radius > self._range:
            return False
        reach = away + radius
        pillars = near_pillars[1][: bisect_right(near_pillars[0], reach)]
        if abs(y) < self._half_width and abs(eye[1]) < self._half_width:
            screens = near_screens[1][: bisect_right(near_screens[0], reach)]
        else:
            screens = self._screens
        if not (screens or pillars):
            return True
        hiding: Screen | Pillar | None = behind_pillar(eye, (x, y, height), pillars, number)
        hiding = hiding or behind_screen(eye, (x, y, height), screens, number)
        if hiding is None:
            return True
        aside = radius / away if away > 0.0 else 0.0
        side_x, side_y = -aside * ray_y, aside * ray_x
        # What hides the middle mostly hides the sides as well, so it is asked first.
        return any(
            not _hides(hiding, eye, point)
            and not behind_pillar(eye, point, pillars, number)
            and not behind_screen(eye, point, screens, number)
            for point in ((x + side_x, y + side_y, height), (x - side_x, y - side_y, height))
        )


def _placed(eye: Point, pose: Pose) -> Point:
    x, y, theta = pose
    cos, sin = math.cos(theta), math.sin(theta)
    return x + cos * eye[0] - sin * eye[1], y + sin * eye[0] + cos * eye[1], eye[2]


def _by_distance(
    eye: Point, occluders: list[tuple[float, float, float, Occluder]]
) -> tuple[list[float], list[Occluder]]:
    """Return how near occluders ``(x, y, reach, occluder)`` may begin, and them, nearest first."""
    if not occluders:
        return [], []
    x, y, _ = eye
    near = [(math.hypot(o[0] - x, o[1] - y) - o[2], n) for n, o in enumerate(occluders)]
    near.sort()
    return [away for away, _ in near], [occluders[n][3] for _, n in near]


def _hides(one: Screen | Pillar, eye: Point, point: Point) -> bool:
    if isinstance(one, Screen):
        return behind_screen(eye, point, (one,)) is not None
    return behind_pillar(eye, point, (one,)) is not None


def covering_discs(box: Rectangle) -> list[Disc]:
    """Return discs in a row, as few as there are squares in it, that cover a rectangle, m."""
    x, y, length, width, yaw = box
    if width > length:
        length, width, yaw = width, length, yaw + math.pi / 2.0
    count = math.ceil(length / width - 1e-9)
    half = length / count
    radius = math.hypot(half, width)
    places = [half * (2 * number + 1) - length for number in range(count)]
    return [(x + at * math.cos(yaw), y + at * math.sin(yaw), radius) for at in places]
