"""What distances and sight cost a control step, against the number of things around."""

from __future__ import annotations

import math

import numpy as np

from cowalk.sim.basics.path import Path
from cowalk.sim.bullet.distances import EngineClearance
from cowalk.sim.env.env import parallel_env
from cowalk.sim.plant.discs import HUMAN_RADIUS
from cowalk.sim.robot.shipped import BASE_RADIUS
from cowalk.sim.world.clearance import Clearance
from cowalk.sim.world.eyes import Eyes
from cowalk.sim.world.footprint import furniture, walls
from cowalk.sim.world.outline import across, rectangle
from cowalk.sim.world.world import Corridor, Furniture, Obstacle, Pedestrian, World

from .timing import best

COUNTS = (0, 5, 20, 50, 100)
STEPS = 500
RADII = (BASE_RADIUS, HUMAN_RADIUS)
BOXES = (
    (0, rectangle(-0.4, 0.4, -0.25, 0.25)),
    (1, across(0.45, 0.24)),
    (2, rectangle(-1.2, 0.0, -0.25, 0.25, underside=0.9)),
)


def crowded(count: int) -> World:
    """Return a corridor with so many things in it: pillars, furniture, one pedestrian in ten."""
    rng = np.random.default_rng(count)
    x, y = rng.uniform(0.0, 20.0, count), rng.uniform(-1.7, 1.7, count)
    passers = count // 10
    pillars = (count - passers) // 2
    return World(
        Path(((0.0, 0.0), (20.0, 0.0))),
        Corridor(3.6),
        tuple(Obstacle(x[i], y[i], 0.1, "pillar") for i in range(pillars)),
        furniture=tuple(
            Furniture(x[i], y[i], 0.5, 0.2, x[i]) for i in range(pillars, count - passers)
        ),
        pedestrians=tuple(
            Pedestrian(((x[i], -1.5), (x[i], 1.5)), back_and_forth=True)
            for i in range(count - passers, count)
        ),
    )


class ArrayClearance:
    """The closed form in array operations, for comparison; nobody moves."""

    def __init__(self, world: World) -> None:
        boxes = [*walls(world), *map(furniture, world.furniture)]
        self._x, self._y, self._length, self._width, yaw = np.array(boxes).T
        self._cos, self._sin = np.cos(yaw), np.sin(yaw)
        discs = [(o.x, o.y, o.radius) for o in world.obstacles]
        self._discs = np.array(discs).reshape(-1, 3)

    def __call__(self, time: float, *positions: tuple[float, ...]) -> float:
        """Return the clearance of two bodies, m."""
        places = np.array(positions)
        dx, dy = places[:, 0, None] - self._x, places[:, 1, None] - self._y
        along = np.abs(self._cos * dx + self._sin * dy) - self._length
        across = np.abs(self._cos * dy - self._sin * dx) - self._width
        outside = np.hypot(np.maximum(along, 0.0), np.maximum(across, 0.0))
        gap = outside + np.minimum(np.maximum(along, across), 0.0)
        nearest = gap.min(axis=1)
        if len(self._discs):
            away = np.hypot(*(places[:, None, :2] - self._discs[:, :2]).transpose(2, 0, 1))
            nearest = np.minimum(nearest, (away - self._discs[:, 2]).min(axis=1))
        return float((nearest - RADII).min())


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, value, unit)."""
    env = parallel_env()
    env.reset(seed=0)
    plant, substeps = env._plant, env.rates.substeps
    bodies, eye = plant.bodies.parts, plant.bodies.eyes["human"]

    def bare() -> None:
        for _ in range(STEPS * substeps):
            plant.bare_step()

    bases = [(20.0 * step / STEPS, 0.1 * math.sin(step / 50.0), 0.0) for step in range(STEPS)]
    humans = [(x - 0.1, y - 0.65, 0.0) for x, y, _ in bases]

    def walk(measured: Clearance | EngineClearance | ArrayClearance) -> None:
        for step in range(STEPS):
            measured(0.05 * step, bases[step], humans[step])

    def turn(measured: EngineClearance) -> None:
        for step in range(STEPS):
            (x, y, _), yaw = bases[step], 0.3 * math.sin(step / 20.0)
            measured(0.05 * step, (x, y, yaw), humans[step], (x - 0.4, y, yaw))

    def look(eyes: Eyes) -> None:
        for step in range(STEPS):
            eyes.look(bases[step], humans[step], 0.05 * step)

    rows: list[tuple[str, float, str]] = []
    for count in COUNTS:
        world = crowded(count)
        engine, boxes = EngineClearance(world, bodies), EngineClearance(world, BOXES)
        parts = {
            "bare engine steps": bare,
            "distances by the engine": lambda engine=engine: walk(engine),
            "distances of a box and a load": lambda boxes=boxes: turn(boxes),
            "distances in closed form": lambda world=world: walk(Clearance(world, bodies)),
            "the same in arrays": lambda world=world: walk(ArrayClearance(world)),
            "sight of one seat": lambda world=world: look(Eyes(world, "human", eye)),
        }
        wall = dict.fromkeys(parts, math.inf)
        for _ in range(3):
            for name, part in parts.items():
                wall[name] = min(wall[name], best(part, 1))
        engine.close()
        boxes.close()
        unit = wall.pop("bare engine steps")
        for name, seconds in wall.items():
            rows.append((f"{count} things: {name}", seconds / STEPS * 1e6, "us"))
            rows.append((f"{count} things: {name}, ratio to bare steps", seconds / unit, "1"))
    env.close()
    return rows
