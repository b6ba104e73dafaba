"""What the pair walks through: a path, a corridor, and things on the floor."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .motion import Path

SEATS = ("human", "automation")
"""The two seats of the environment, in the order in which they are stepped."""


@dataclass(frozen=True)
class Obstacle:
    """A round thing on the floor.

    Parameters
    ----------
    x, y : float
        Centre in m, world axes.
    radius : float
        Radius in m.
    kind : str
        ``"puddle"`` is marked on the floor and can be walked through, anything else is solid.
    seen_by : tuple of str
        Seats that perceive it, out of ``"human"`` and ``"automation"``.
    """

    x: float
    y: float
    radius: float
    kind: str = "puddle"
    seen_by: tuple[str, ...] = SEATS

    @property
    def solid(self) -> bool:
        """Whether touching it is a collision."""
        return self.kind != "puddle"


@dataclass(frozen=True)
class Corridor:
    """Straight walls at y = -width/2 and y = +width/2 (m), parallel to the world's x axis."""

    width: float


@dataclass(frozen=True)
class World:
    """Path, walls, obstacles and the pose from which the base starts.

    Parameters
    ----------
    path : Path
        Global path of the automation.
    corridor : Corridor or None
        Walls; None is open ground.
    obstacles : tuple of Obstacle
    start : (x, y, theta)
        Initial base pose in m, m, rad, world axes.
    """

    path: Path
    corridor: Corridor | None = None
    obstacles: tuple[Obstacle, ...] = ()
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)


class Clearance:
    """Signed distance from round bodies to everything in a world, set up once and then cheap.

    Parameters
    ----------
    world : World
    radii : sequence of float
        Radius in m of each body (base, human), in the order in which `distances` gets them.
    """

    def __init__(self, world: World, radii: tuple[float, ...]) -> None:
        self._radii = radii
        self._half_width = world.corridor.width / 2.0 if world.corridor else math.inf
        self._discs = tuple((o.x, o.y, o.radius, o.solid) for o in world.obstacles)

    def __call__(self, *positions: tuple[float, ...]) -> tuple[float, float]:
        """Return the clearance to anything, and the clearance to solid things alone, in m.

        Parameters
        ----------
        *positions : (x, y, ...)
            World position of each body, in m; further entries are ignored.

        Returns
        -------
        (float, float)
            Negative inside an obstacle, infinite where there is none.
        """
        nearest = nearest_solid = math.inf
        for radius, position in zip(self._radii, positions, strict=True):
            x, y = position[0], position[1]
            nearest_solid = min(nearest_solid, self._half_width - abs(y) - radius)
            for ox, oy, size, solid in self._discs:
                gap = ((x - ox) ** 2 + (y - oy) ** 2) ** 0.5 - size - radius
                if solid:
                    nearest_solid = min(nearest_solid, gap)
                else:
                    nearest = min(nearest, gap)
        return min(nearest, nearest_solid), nearest_solid
