"""What the pair walks through: a path, walls, and what stands, lies and walks there."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from numbers import Real

from ..basics.errors import InputError
from ..basics.path import Path
from ..basics.seats import SEATS, check_seats
from .heights import usual_height
from .pedestrians import Pedestrian
from .walls import Corridor, Doorway, SideCorridor, Wall, require_positive

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


def _not_finite(name: str, value: object) -> Iterator[str]:
    """Yield name and value of every number inside that is not finite."""
    if isinstance(value, tuple | list):
        for number, part in enumerate(value):
            yield from _not_finite(f"{name}.{number}", part)
    elif isinstance(value, Real):
        if not math.isfinite(value):
            yield f"{name} = {value}"
    elif is_dataclass(value):
        for item in fields(value):
            if item.init:
                yield from _not_finite(f"{name}.{item.name}", getattr(value, item.name))


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
        m; without it the usual one of its kind (`cowalk.sim.world.heights`).
    """

    x: float
    y: float
    radius: float
    kind: str = "puddle"
    seen_by: tuple[str, ...] = SEATS
    height: float | None = None

    def __post_init__(self) -> None:
        require_positive(self, "radius", "height")
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
        m; without it the usual one of its kind (`cowalk.sim.world.heights`). Who has their eyes
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
        require_positive(self, "length", "width", "height")
        check_seats(self.seen_by)
        _settle_height(self)

    @property
    def top(self) -> float:
        """How high it is, m."""
        return self.height or 0.0


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

    Raises
    ------
    InputError
        If a number of a place or a size is not finite.
    """

    path: Path
    corridor: Corridor | None = None
    obstacles: tuple[Obstacle, ...] = ()
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    furniture: tuple[Furniture, ...] = ()
    pedestrians: tuple[Pedestrian, ...] = ()
    walls: tuple[Wall, ...] = ()
    view_range: ViewRange = ViewRange()

    def __post_init__(self) -> None:
        for name in ("path", "corridor", "obstacles", "start", "furniture", "pedestrians", "walls"):
            for fault in _not_finite(name, getattr(self, name)):
                raise InputError(f"{fault}: must be finite")
