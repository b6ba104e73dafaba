"""Distances in PyBullet: base and body as cylinders among the solid shapes of a world.

They stand in an engine world of their own, since shapes that may touch would slow every physics
step down, while distances are asked for once a control step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .bullet_engine import connect, disconnect, engine
from .footprint import furniture, walls
from .world import World

HEIGHT = 2.0
"""Of every shape, m: bodies and things stand side by side, so distances are level."""
FAR = 1e3
"""Distance up to which the engine is asked to look, m."""
SLACK = 0.01
"""Added to bounds on distances, m: far above the engine's own error, 0.5 mm."""
KEPT = 4
"""Empty engine worlds kept for the next ones: emptying one takes a tenth of opening one."""
_idle: list[int] = []
UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@dataclass
class _Body:
    """A body, where it was, and between what its distance to everything lay there."""

    number: int
    index: int
    x: float = 0.0
    y: float = 0.0
    at_least: float = -math.inf
    at_most: float = math.inf


def _at_most(body: _Body) -> float:
    return body.at_most


class EngineClearance:
    """Signed distances by the engine's closest points.

    Parameters
    ----------
    world : World
    radii : sequence of float
        Radius in m of each body (base, human), in the order in which calls get them.
    """

    def __init__(self, world: World, radii: tuple[float, ...]) -> None:
        self._client = _empty_client()
        self._time = 0.0
        self._bodies = [
            _Body(number, self._body(self._cylinder(radius))) for number, radius in enumerate(radii)
        ]
        self._walkers = [
            (walker, self._body(self._cylinder(walker.radius))) for walker in world.pedestrians
        ]
        shapes = [(self._cylinder(o.radius), o.x, o.y, 0.0, o.solid) for o in world.obstacles]
        for box in (*walls(world), *map(furniture, world.furniture)):
            shape = engine.createCollisionShape(
                engine.GEOM_BOX,
                halfExtents=(box.half_length, box.half_width, HEIGHT / 2.0),
                physicsClientId=self._client,
            )
            shapes.append((shape, box.x, box.y, box.yaw, True))
        self._solid = [solid for *_, solid in shapes]
        # One body, a link each: the engine is asked once for all of them.
        self._scene = self._scenery(shapes) if shapes else None

    def _cylinder(self, radius: float) -> int:
        shape: int = engine.createCollisionShape(
            engine.GEOM_CYLINDER, radius=radius, height=HEIGHT, physicsClientId=self._client
        )
        return shape

    def _body(self, shape: int) -> int:
        body: int = engine.createMultiBody(0.0, shape, physicsClientId=self._client)
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
        return body

    def __call__(self, time: float, *positions: tuple[float, ...]) -> tuple[float, bool]:
        """See `cowalk.sim.clearance.Distances`."""
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
            x, y = positions[body.number][:2]
            moved = math.hypot(x - body.x, y - body.y) + walked + SLACK
            body.x, body.y = x, y
            body.at_least -= moved
            body.at_most += moved
            if body.at_least > max(nearest, SLACK):
                continue
            place(body.index, (x, y, 0.0), UPRIGHT, client)
            reach = min(max(min(body.at_most, nearest), 0.0) + SLACK, FAR)
            found, solid = self._closest(body.index, reach)
            touching = touching or solid < 0.0
            if found < math.inf:
                body.at_least = body.at_most = found
                nearest = min(nearest, found)
            else:
                body.at_least = reach
        return nearest, touching

    def _closest(self, body: int, reach: float) -> tuple[float, float]:
        """Return the distance to anything and to something solid, infinite beyond the reach."""
        marked = solid = math.inf
        closest, client = engine.getClosestPoints, self._client
        if self._scene is not None:
            for point in closest(body, self._scene, reach, physicsClientId=client):
                if self._solid[point[4]]:
                    solid = min(solid, point[8])
                else:
                    marked = min(marked, point[8])
        for _, other in self._walkers:
            for point in closest(body, other, reach, physicsClientId=client):
                solid = min(solid, point[8])
        return min(marked, solid), solid

    def close(self) -> None:
        """Free the world. May be called twice."""
        if self._client < 0:
            return
        engine.resetSimulation(physicsClientId=self._client)
        if len(_idle) < KEPT:
            _idle.append(self._client)
        else:
            disconnect(self._client)
        self._client = -1


def _empty_client() -> int:
    """Return an empty engine world: one that was given back, or a new one."""
    while _idle:
        client = _idle.pop()
        if engine.isConnected(client):
            return client
    return connect()
