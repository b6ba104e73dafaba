"""What the pair walks through: a path, walls, and what stands, lies and walks there."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..basics.lists import require_entries, require_instances
from ..basics.path import PLACE, Path
from ..basics.seats import SEATS, require_seats
from ..basics.validators import (
    Range,
    require,
    require_instance,
    require_range,
    require_ranges,
    require_text,
)
from .heights import usual_height
from .pedestrians import Pedestrian
from .walls import SIZE, Corridor, Doorway, SideCorridor, Wall

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


ANGLE: Range = (-1000.0, 1000.0, "rad")
"""Of what stands there: some turns more than one, but not nonsense (inferred)."""
SIGHT: Range = (0.01, 1e5, "m")
"""That is no limit at all (inferred)."""


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

    Raises
    ------
    InputError
        If a place is outside of `PLACE` or a size outside of `SIZE`, a puddle has a height, or a
        seat is unknown.
    """

    x: float
    y: float
    radius: float
    kind: str = "puddle"
    seen_by: tuple[str, ...] = SEATS
    height: float | None = None

    def __post_init__(self) -> None:
        require_ranges(self, {"x": PLACE, "y": PLACE, "radius": SIZE, "height": SIZE})
        require_text("kind", self.kind)
        require_seats(self)
        if self.solid:
            _settle_height(self)
        what = "a puddle has none; leave it out"
        require(self.solid or self.height is None, "height", self.height, what, "m")

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

    Raises
    ------
    InputError
        If a place is outside of `PLACE`, a size outside of `SIZE`, the direction outside of
        `ANGLE`, or a seat is unknown.
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
        places = dict.fromkeys(("x", "y"), PLACE) | {"yaw": ANGLE}
        require_ranges(self, places | dict.fromkeys(("length", "width", "height"), SIZE))
        require_text("kind", self.kind)
        require_seats(self)
        _settle_height(self)

    @property
    def top(self) -> float:
        """How high it is, m."""
        return self.height or 0.0


@dataclass(frozen=True)
class ViewRange:
    """How far each seat sees, m, from head or front sensor; without limit unless given.

    Raises
    ------
    InputError
        If one is outside of `SIGHT`, and not infinite.
    """

    human: float = math.inf
    automation: float = math.inf

    def __post_init__(self) -> None:
        require_ranges(self, dict.fromkeys(SEATS, SIGHT))


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
        If a part is of the wrong kind, or the start not a place within `PLACE` and `ANGLE`.
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
        require_instance("path", self.path, Path, "a Path")
        if self.corridor is not None:
            require_instance("corridor", self.corridor, Corridor, "a Corridor, or None,")
        require_instance("view_range", self.view_range, ViewRange, "a ViewRange")
        things = {"obstacles": Obstacle, "furniture": Furniture}
        require_instances(self, things | {"pedestrians": Pedestrian, "walls": Wall})
        require_entries(self, ("start",), 3, PLACE)
        require_range(("start", 2), self.start[2], ANGLE)
