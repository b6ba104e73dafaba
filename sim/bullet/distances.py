"""Distances in PyBullet: the outlines of bodies among the shapes of a world.

They stand in an engine world apart, since shapes that may touch would slow every physics step
down, while distances are asked for once a control step (see `cowalk.sim.bullet.shared_world`).
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Sequence
from dataclasses import dataclass

from ..engine.engine import engine
from ..world.footprint import furniture, walls
from ..world.heights import WALL_HEIGHT
from ..world.outline import Outline
from ..world.world import World
from .shared_world import SHARED

HEIGHT = 2.0
"""Of every shape, m: they all stand on one floor, so distances are level."""
MARGIN = 1e-3
"""By which the engine takes a prism for larger than it is, m."""
FAR = 1e3
"""Distance up to which the engine is asked to look, m."""
SLACK = 0.01
"""Added to bounds on distances, m: far above the engine's own error, 0.5 mm."""
AHEAD = 0.4
"""How much farther than the nearest body's distance others are looked around, m: less is asked
more often, more is slower to ask."""
UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@dataclass
class _Body:
    """A body, where it was, and between what its distance to everything lay there."""

    number: int
    index: int
    swing: float
    """See `Outline.swing`."""
    margin: float
    """What the engine reports too little, m."""
    meets: list[bool]
    """Whether a thing of the scene is in its way, or lower than its underside."""
    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    at_least: float = -math.inf
    at_most: float = math.inf


def _at_most(body: _Body) -> float:
    return body.at_most


class EngineClearance:
    """Signed distances by the engine's closest points.

    Parameters
    ----------
    world : World
    parts : sequence of (int, Outline)
        See `Bodies.parts`: what is measured, and the number of the pose that it goes with.
    """

    def __init__(self, world: World, parts: Sequence[tuple[int, Outline]]) -> None:
        self._client = SHARED.enter()
        self._made: list[int] = []
        self._free = weakref.finalize(self, SHARED.leave, self._client, self._made)
        self._free.atexit = False  # by then the engine may be gone
        self._time = 0.0
        with SHARED.lock:
            self._build(world, parts)

    def _build(self, world: World, parts: Sequence[tuple[int, Outline]]) -> None:
        """Stand everything up in the shared world."""
        self._walkers = [
            (walker, self._body(self._round(walker.radius))) for walker in world.pedestrians
        ]
        shapes = [(self._round(o.radius), o.x, o.y, 0.0, o.solid) for o in world.obstacles]
        tops = [o.top for o in world.obstacles]
        boxes = [(wall, WALL_HEIGHT) for wall in walls(world)]
        boxes += [(furniture(item), item.top) for item in world.furniture]
        for box, top in boxes:
            extents = box.half_length, box.half_width, HEIGHT / 2.0
            shape = SHARED.shape(engine.GEOM_BOX, halfExtents=extents)
            shapes.append((shape, box.x, box.y, box.yaw, True))
            tops.append(top)
        self._solid = [solid for *_, solid in shapes]
        # One body, a link each: the engine is asked once for all of them.
        self._scene = self._scenery(shapes) if shapes else None
        self._bodies = []
        for number, outline in parts:
            shape, margin = self._outline(outline)
            meets = [top >= outline.underside for top in tops]
            self._bodies.append(_Body(number, self._body(shape), outline.swing, margin, meets))

    def _round(self, radius: float, x: float = 0.0, y: float = 0.0) -> int:
        # Not a cylinder: how deep one is inside a long wall the engine sometimes cannot tell.
        return SHARED.shape(
            engine.GEOM_CAPSULE,
            radius=radius,
            height=HEIGHT,
            collisionFramePosition=(x, y, 0.0),
        )

    def _outline(self, outline: Outline) -> tuple[int, float]:
        """Return the shape of an outline, and by how much the engine takes it for larger, m."""
        first, *others = outline.discs
        if not others:
            return self._round(first[2], *first[:2]), 0.0
        if len(others) == 1 and first[2] == others[0][2]:
            dx, dy = others[0][0] - first[0], others[0][1] - first[1]
            # A capsule is built along z; lying at half height it is as far as from above.
            lying = engine.getQuaternionFromEuler((0.0, math.pi / 2.0, math.atan2(dy, dx)))
            shape = SHARED.shape(
                engine.GEOM_CAPSULE,
                radius=first[2],
                height=math.hypot(dx, dy),
                collisionFramePosition=(first[0] + dx / 2.0, first[1] + dy / 2.0, 0.0),
                collisionFrameOrientation=lying,
            )
            return shape, 0.0
        corners = tuple(
            (x, y, z) for x, y in outline.polygon.tolist() for z in (-HEIGHT / 2.0, HEIGHT / 2.0)
        )
        return SHARED.shape(engine.GEOM_MESH, vertices=corners), MARGIN

    def _body(self, shape: int) -> int:
        body: int = engine.createMultiBody(0.0, shape, physicsClientId=self._client)
        self._made.append(body)
        return body

    def _scenery(self, shapes: list[tuple[int, float, float, float, bool]]) -> int:
        count = len(shapes)
        body: int = engine.createMultiBody(
            baseMass=0.0,
            linkMasses=[0.0] * count,
            linkCollisionShapeIndices=[shape for shape, *_ in shapes],
            linkVisualShapeIndices=[-1] * count,
            linkPositions=[(x, y, 0.0) for _, x, y, _, _ in shapes],
            linkOrientations=[
                (0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0)) for *_, yaw, _ in shapes
            ],
            linkInertialFramePositions=[(0.0, 0.0, 0.0)] * count,
            linkInertialFrameOrientations=[UPRIGHT] * count,
            linkParentIndices=[0] * count,
            linkJointTypes=[engine.JOINT_FIXED] * count,
            linkJointAxis=[(0.0, 0.0, 1.0)] * count,
            physicsClientId=self._client,
        )
        self._made.append(body)
        return body

    def __call__(self, time: float, *poses: tuple[float, float, float]) -> tuple[float, bool]:
        """See `cowalk.sim.world.clearance.Distances`."""
        with SHARED.lock:
            return self._measured(time, poses)

    def _measured(
        self, time: float, poses: tuple[tuple[float, float, float], ...]
    ) -> tuple[float, bool]:
        client, place = self._client, engine.resetBasePositionAndOrientation
        passed = abs(time - self._time)
        self._time = time
        walked = 0.0
        for walker, index in self._walkers:
            x, y, _, _ = walker.state(time)
            place(index, (x, y, 0.0), UPRIGHT, client)
            walked = max(walked, walker.speed * passed)
        # A distance changes by no more than what moved: looking farther than that, or for a body
        # that cannot be the nearest, would be most of the cost.
        nearest, touching = math.inf, False
        for body in sorted(self._bodies, key=_at_most):
            x, y, yaw = poses[body.number]
            moved = math.hypot(x - body.x, y - body.y) + walked + SLACK
            moved += body.swing * abs(yaw - body.yaw)
            body.x, body.y, body.yaw = x, y, yaw
            body.at_least -= moved
            body.at_most += moved
            if body.at_least > max(nearest, SLACK):
                continue
            turn = (0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0))
            place(body.index, (x, y, 0.0), turn, client)
            # Farther than the nearest: a body that is not it is then left alone for a while.
            reach = min(max(min(body.at_most + SLACK, nearest + AHEAD), SLACK), FAR)
            found, solid = self._closest(body, reach)
            touching = touching or solid < 0.0
            if found < math.inf:
                body.at_least = body.at_most = found
                nearest = min(nearest, found)
            else:
                body.at_least = reach
        return nearest, touching

    def _closest(self, body: _Body, reach: float) -> tuple[float, float]:
        """Return the distance to anything and to something solid, infinite beyond the reach."""
        marked = solid = math.inf
        closest, client, index, meets = (
            engine.getClosestPoints,
            self._client,
            body.index,
            body.meets,
        )
        if self._scene is not None:
            for point in closest(index, self._scene, reach, physicsClientId=client):
                if not meets[point[4]]:
                    continue
                if self._solid[point[4]]:
                    solid = min(solid, point[8])
                else:
                    marked = min(marked, point[8])
        for _, other in self._walkers:
            for point in closest(index, other, reach, physicsClientId=client):
                solid = min(solid, point[8])
        return min(marked, solid) + body.margin, solid + body.margin

    def close(self) -> None:
        """Take its bodies away. May be called twice."""
        self._free()
