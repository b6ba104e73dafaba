"""What a world looks like in PyBullet: floor, walls, things, and the people who pass."""

from __future__ import annotations

import math

from ..basics.frames import Vector
from ..engine.engine import engine
from ..world.footprint import Rectangle, furniture, pieces, walls
from ..world.pedestrians import Pedestrian
from ..world.world import World
from .floor import Floor, floor_areas, lay_floor
from .shapes import DRAWN_WALL_HEIGHT, PUDDLE, SOLID, WALL, Colour

DRAWN_CROSS_WALL_HEIGHT = 1.1
"""Of walls across the corridor, m: a doorway must look like one, and be looked over."""
WALL_PIECE = 2.0
"""Walls are built in pieces, m: what a triangle costs to render is the rectangle around it."""
MARGIN = 6.0
"""How far floor and walls reach beyond path and start, m."""
TOP = (0.66, 0.53, 0.38, 1.0)
SKIN, HAIR, TROUSERS = (0.80, 0.61, 0.47, 1.0), (0.15, 0.12, 0.10, 1.0), (0.25, 0.25, 0.28, 1.0)
SHIRTS: tuple[Colour, ...] = (
    (0.25, 0.50, 0.35, 1.0),
    (0.50, 0.35, 0.55, 1.0),
    (0.75, 0.60, 0.25, 1.0),
)


class Scenery:
    """The visible world, in a client of somebody else.

    Parameters
    ----------
    client : int
        Where to build it.
    world : World
    floor : bool
        Lay a floor; pictures get theirs painted (`cowalk.sim.view.floor.Floor`).
    """

    def __init__(self, client: int, world: World, floor: bool = True) -> None:
        self._client = client
        areas = floor_areas(world, MARGIN)
        self.floor = Floor(areas)
        """Paints the floor."""
        self.flat = [body for area in areas if floor for body in lay_floor(client, *area)]
        """Bodies that lie on the floor or are it."""
        for wall in walls(world, MARGIN):
            across = wall.half_length < wall.half_width or wall.yaw != 0.0
            for piece in pieces(wall, WALL_PIECE):
                self._block(piece, DRAWN_CROSS_WALL_HEIGHT if across else DRAWN_WALL_HEIGHT, WALL)
        for item in world.furniture:
            self._furnish(furniture(item), item.top)
        for thing in world.obstacles:
            height = thing.top if thing.solid else 0.004
            body = self._place(
                self._shape(
                    engine.GEOM_CYLINDER,
                    SOLID if thing.solid else PUDDLE,
                    radius=thing.radius,
                    length=height,
                ),
                (thing.x, thing.y, height / 2.0),
            )
            if not thing.solid:
                self.flat.append(body)
        self._walkers = [
            (walker, self._person(walker, SHIRTS[number % len(SHIRTS)]))
            for number, walker in enumerate(world.pedestrians)
        ]
        self.show(0.0)

    def show(self, time: float) -> None:
        """Move the people to where they are at a time since reset (s)."""
        for walker, parts in self._walkers:
            x, y, vx, vy = walker.state(time)
            if vx == vy == 0.0:  # stands as one came, or as one will go
                _, _, vx, vy = walker.state(max(walker.start_time + 1e-6, time - 60.0))
            yaw = math.atan2(vy, vx)
            cos, sin = math.cos(yaw), math.sin(yaw)
            turn = (0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0))
            for part, (ahead, left, up) in parts:
                place = (x + cos * ahead - sin * left, y + sin * ahead + cos * left, up)
                engine.resetBasePositionAndOrientation(part, place, turn, self._client)

    def _block(self, box: Rectangle, height: float, colour: Colour, base: float = 0.0) -> None:
        shape = self._shape(
            engine.GEOM_BOX,
            colour,
            halfExtents=(box.half_length, box.half_width, (height - base) / 2.0),
        )
        self._place(shape, (box.x, box.y, (base + height) / 2.0), box.yaw)

    def _furnish(self, box: Rectangle, height: float) -> None:
        """Build a body and, a little wider, a top."""
        edge = min(0.03, box.half_length / 4.0, box.half_width / 4.0)
        body = box._replace(half_length=box.half_length - edge, half_width=box.half_width - edge)
        self._block(body, 0.92 * height, SOLID)
        self._block(box, height, TOP, 0.92 * height)

    def _person(self, walker: Pedestrian, shirt: Colour) -> list[tuple[int, Vector]]:
        """Return the parts of a person and where each is when they look along x from 0."""
        wide = walker.radius / 0.22
        parts = [
            (TROUSERS, "capsule", 0.075 * wide, 0.66, (0.10, 0.09 * wide, 0.42)),
            (TROUSERS, "capsule", 0.075 * wide, 0.66, (-0.10, -0.09 * wide, 0.42)),
            (shirt, "capsule", 0.13 * wide, 0.36, (0.0, 0.06 * wide, 1.13)),
            (shirt, "capsule", 0.13 * wide, 0.36, (0.0, -0.06 * wide, 1.13)),
            (shirt, "capsule", 0.05 * wide, 0.45, (-0.04, 0.20 * wide, 1.08)),
            (shirt, "capsule", 0.05 * wide, 0.45, (0.04, -0.20 * wide, 1.08)),
            (SKIN, "capsule", 0.05, 0.10, (0.0, 0.0, 1.46)),
            (SKIN, "sphere", 0.10, 0.0, (0.02, 0.0, 1.60)),
            (HAIR, "sphere", 0.105, 0.0, (-0.01, 0.0, 1.63)),
        ]
        built = []
        for colour, kind, radius, length, place in parts:
            sizes = {"radius": radius} | ({"length": length} if kind == "capsule" else {})
            geometry = engine.GEOM_CAPSULE if kind == "capsule" else engine.GEOM_SPHERE
            built.append((self._place(self._shape(geometry, colour, **sizes), place), place))
        return built

    def _shape(self, geometry: int, colour: Colour, **sizes: float | Vector) -> int:
        shape: int = engine.createVisualShape(
            geometry, rgbaColor=colour, physicsClientId=self._client, **sizes
        )
        return shape

    def _place(self, shape: int, centre: Vector, yaw: float = 0.0) -> int:
        body: int = engine.createMultiBody(
            baseMass=0.0,
            baseVisualShapeIndex=shape,
            basePosition=centre,
            baseOrientation=(0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0)),
            physicsClientId=self._client,
        )
        return body
