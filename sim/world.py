"""What the pair walks through: a path, walls, and what stands, lies and walks there."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Literal

from .errors import InputError
from .heights import usual_height
from .path import Path
from .pedestrians import Pedestrian
from .seats import SEATS, check_seats

__all__ = [
    "SEATS",
    "Corridor",
    "Doorway",
    "Furniture",
    "Obstacle",
    "Pedestrian",
    "SideCorridor",
    "ViewRange",
    "Wall",
    "World",
]


def _positive(thing: object, *names: str) -> None:
    for name in names:
        value = getattr(thing, name)
        if value is not None and not 0.0 < value < math.inf:
            raise InputError(f"{name} = {value} m: it must be above 0")


def _settle_height(thing: Obstacle | Furniture) -> None:
    """Give a thing without a height the usual one: it is then written out with the others."""
    if thing.height is None:
        object.__setattr__(thing, "height", usual_height(thing.kind))


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
        Seats that perceive it, out of ``"human"`` and ``"automation"``, once it is in sight.
    height : float, optional
        m; without it the usual one of its kind (`cowalk.sim.heights`).
    """

    x: float
    y: float
    radius: float
    kind: str = "puddle"
    seen_by: tuple[str, ...] = SEATS
    height: float | None = None

    def __post_init__(self) -> None:
        _positive(self, "radius", "height")
        check_seats(self.seen_by)
        if self.solid:
            _settle_height(self)
        elif self.height is not None:
            raise InputError(f"height = {self.height} m: a puddle has none; leave it out")

    @property
    def solid(self) -> bool:
        """Whether touching it is a collision."""
        return self.kind != "puddle"

    @property
    def top(self) -> float:
        """How high it is, m."""
        return self.height or 0.0


@dataclass(frozen=True)
class Furniture:
    """A solid box on the floor: a bed, a cupboard, a trolley.

    Parameters
    ----------
    x, y : float
        Centre in m, world axes.
    length, width : float
        Sides in m.
    yaw : float
        Direction of ``length``, rad from the x axis.
    height : float, optional
        m; without it the usual one of its kind (`cowalk.sim.heights`). Who has their eyes
        above it looks over it, at what is high enough behind it.
    kind : str
        What it is: a table, a cupboard.
    seen_by : tuple of str
        Seats that perceive it once it is in sight.
    """

    x: float
    y: float
    length: float
    width: float
    yaw: float = 0.0
    height: float | None = None
    kind: str = "furniture"
    seen_by: tuple[str, ...] = SEATS

    def __post_init__(self) -> None:
        _positive(self, "length", "width", "height")
        check_seats(self.seen_by)
        _settle_height(self)

    @property
    def top(self) -> float:
        """How high it is, m."""
        return self.height or 0.0


@dataclass(frozen=True)
class Wall:
    """A straight wall from one point to another, in m, world axes; ``thickness`` in m."""

    start: tuple[float, float]
    end: tuple[float, float]
    thickness: float = 0.1

    def __post_init__(self) -> None:
        _positive(self, "thickness")
        if tuple(self.start) == tuple(self.end):
            raise InputError(f"end = {list(self.end)}: it is where the wall starts")


@dataclass(frozen=True)
class Doorway:
    """An opening in a wall across the corridor.

    Parameters
    ----------
    x : float
        Where the wall stands, m, world axes.
    width : float
        Clear width of the opening, m. Base and human beside it take 1.16 m.
    y : float
        Centre of the opening, m, world axes.
    """

    x: float
    width: float
    y: float = 0.0

    def __post_init__(self) -> None:
        _positive(self, "width")


@dataclass(frozen=True)
class SideCorridor:
    """A dead end that leaves the corridor at a right angle.

    Parameters
    ----------
    x : float
        Its middle, m, world axes.
    width : float
        Clear width, m.
    side : {"left", "right"}
        On which side of the x axis it lies: left is y > 0.
    length : float
        From the corridor's wall to its own end, m.
    """

    x: float
    width: float
    side: Literal["left", "right"] = "left"
    length: float = 4.0

    def __post_init__(self) -> None:
        _positive(self, "width", "length")


@dataclass(frozen=True)
class Corridor:
    """Straight walls at y = -width/2 and y = +width/2 (m), parallel to the world's x axis.

    Parameters
    ----------
    width : float
        Clear width, m.
    doorways : tuple of Doorway
        Walls across it with an opening each.
    side_corridors : tuple of SideCorridor
        What branches off.

    Raises
    ------
    InputError
        If a doorway lies outside, or two side corridors of one side overlap.
    """

    width: float
    doorways: tuple[Doorway, ...] = ()
    side_corridors: tuple[SideCorridor, ...] = ()

    def __post_init__(self) -> None:
        _positive(self, "width")
        for number, door in enumerate(self.doorways):
            if abs(door.y) + door.width / 2.0 > self.width / 2.0:
                raise InputError(
                    f"doorways.{number} reaches from {door.y - door.width / 2.0:g} to "
                    f"{door.y + door.width / 2.0:g} m, beyond the corridor's {self.width:g} m"
                )
        for side in ("left", "right"):
            here = sorted((s.x, s.width) for s in self.side_corridors if s.side == side)
            for (x, width), (next_x, next_width) in itertools.pairwise(here):
                if x + width / 2.0 >= next_x - next_width / 2.0:
                    raise InputError(
                        f"side_corridors: those at x = {x:g} and {next_x:g} m, {side}, overlap"
                    )


@dataclass(frozen=True)
class ViewRange:
    """How far each seat sees, m, from head or front sensor; without limit unless given."""

    human: float = math.inf
    automation: float = math.inf

    def __post_init__(self) -> None:
        for seat in SEATS:
            if not getattr(self, seat) > 0.0:
                raise InputError(f"{seat} = {getattr(self, seat)} m: it must be above 0")


@dataclass(frozen=True)
class World:
    """Path, walls, what is in the way, and the pose from which the base starts.

    Parameters
    ----------
    path : Path
        Global path of the automation.
    corridor : Corridor or None
        Walls; None is open ground.
    obstacles : tuple of Obstacle
    start : (x, y, theta)
        Initial base pose in m, m, rad, world axes.
    furniture : tuple of Furniture
    pedestrians : tuple of Pedestrian
    walls : tuple of Wall
        Further walls, wherever they stand.
    view_range : ViewRange
    """

    path: Path
    corridor: Corridor | None = None
    obstacles: tuple[Obstacle, ...] = ()
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    furniture: tuple[Furniture, ...] = ()
    pedestrians: tuple[Pedestrian, ...] = ()
    walls: tuple[Wall, ...] = ()
    view_range: ViewRange = ViewRange()
