"""Plain shapes that bodies are shown as, and a figure for plants that have no bodies. Pure."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..basics.frames import Vector
from ..plant.discs import HUMAN_RADIUS
from ..plant.protocol import PlantState
from ..robot.shipped import BASE_RADIUS
from ..world.footprint import furniture, walls
from ..world.world import World

Quaternion = tuple[float, float, float, float]
Colour = tuple[float, float, float, float]
Place = tuple[Vector, Quaternion]
"""Position in m and orientation (x, y, z, w)."""

UPRIGHT: Quaternion = (0.0, 0.0, 0.0, 1.0)
SHELL, SHIRT, SKIN, TROUSERS = (
    (0.93, 0.94, 0.95, 1.0),
    (0.75, 0.22, 0.20, 1.0),
    (0.87, 0.68, 0.54, 1.0),
    (0.20, 0.25, 0.40, 1.0),
)
WALL, PUDDLE, SOLID = (0.55, 0.57, 0.60, 1.0), (0.20, 0.50, 0.90, 1.0), (0.55, 0.42, 0.28, 1.0)
DRAWN_WALL_HEIGHT = 0.25
"""m; low, so that one looks over the near wall."""
BEYOND = 3.0
"""How far walls reach beyond the path, m."""


@dataclass(frozen=True)
class Shape:
    """A visible shape, fixed to a part.

    Attributes
    ----------
    part : str
        Name of the part it belongs to: ``body/link``, or ``scenery/number``.
    kind : str
        ``"box"``, ``"sphere"``, ``"cylinder"``, ``"capsule"`` or ``"mesh"``.
    size : (float, float, float)
        Edges of a box; length (along z, without caps) and radius of a cylinder or a capsule;
        radius of a sphere; scale of a mesh. m.
    place : (position, orientation)
        In the part's frame; of the middle of the shape.
    colour : (r, g, b, a)
        In [0, 1].
    file : str
        Of a mesh.
    """

    part: str
    kind: str
    size: Vector
    place: Place
    colour: Colour
    file: str = ""


def plain_figures(world: World) -> list[Shape]:
    """Return a base, a human and what stands in a world, for plants that have no bodies."""

    def upright(part: str, kind: str, middle: Vector, size: Vector, colour: Colour) -> Shape:
        return Shape(part, kind, size, (middle, UPRIGHT), colour)

    leg, arm = HUMAN_RADIUS / 2.0, HUMAN_RADIUS + 0.04
    shapes = [
        upright("base/body", "cylinder", (0.0, 0.0, 0.2), (0.4, BASE_RADIUS, 0.0), SHELL),
        upright("base/body", "cylinder", (0.0, 0.0, 0.7), (0.6, 0.03, 0.0), SHELL),
        upright("human/body", "capsule", (0.0, 0.0, 1.17), (0.36, 0.14, 0.0), SHIRT),
        upright("human/body", "sphere", (0.0, 0.0, 1.63), (0.11, 0.0, 0.0), SKIN),
        *(
            upright("human/body", "capsule", (0.0, side * y, z), (length, radius, 0.0), colour)
            for side in (-1.0, 1.0)
            for y, z, length, radius, colour in (
                (leg, 0.48, 0.80, 0.075, TROUSERS),
                (arm, 1.10, 0.50, 0.045, SHIRT),
            )
        ),
    ]
    stands = [("walls", box, DRAWN_WALL_HEIGHT, WALL) for box in walls(world, BEYOND)]
    stands += [("furniture", furniture(item), item.top, SOLID) for item in world.furniture]
    for name, box, height, colour in stands:
        turn = (0.0, 0.0, math.sin(box.yaw / 2.0), math.cos(box.yaw / 2.0))
        sides = (2.0 * box.half_length, 2.0 * box.half_width, height)
        place = ((box.x, box.y, height / 2.0), turn)
        shapes.append(Shape(f"scenery/{name}", "box", sides, place, colour))
    for thing in world.obstacles:
        height, colour = (thing.top, SOLID) if thing.solid else (0.004, PUDDLE)
        middle = (thing.x, thing.y, height / 2.0)
        size = (height, thing.radius, 0.0)
        shapes.append(upright("scenery/obstacles", "cylinder", middle, size, colour))
    return shapes


def plain_places(state: PlantState) -> dict[str, Place]:
    """Return where the moving parts of `plain_figures` are, world axes."""
    return {
        f"{name}/body": ((x, y, 0.0), (0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0)))
        for name, (x, y, yaw) in (("base", state.pose), ("human", state.human_pose))
    }
