"""Walls: of a corridor, with doorways across and side corridors off it, or wherever they stand."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Literal

from ..basics.errors import InputError
from ..basics.lists import require_entries, require_instances
from ..basics.path import PLACE
from ..basics.validators import Range, require, require_choices, require_ranges

SIZE: Range = (1e-3, 1000.0, "m")
"""Of things and rooms, m: a large hall (inferred)."""


@dataclass(frozen=True)
class Wall:
    """A straight wall from one point to another, in m, world axes; ``thickness`` in m.

    Raises
    ------
    InputError
        If an end is not two numbers within `PLACE`, both are the same, or the thickness is
        outside of `SIZE`.
    """

    start: tuple[float, float]
    end: tuple[float, float]
    thickness: float = 0.1

    def __post_init__(self) -> None:
        require_ranges(self, {"thickness": SIZE})
        require_entries(self, ("start", "end"), 2, PLACE)
        require(self.start != self.end, "end", list(self.end), "it is where the wall starts")


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

    Raises
    ------
    InputError
        If a place is outside of `PLACE`, or a size outside of `SIZE`.
    """

    x: float
    width: float
    y: float = 0.0

    def __post_init__(self) -> None:
        require_ranges(self, {"x": PLACE, "width": SIZE, "y": PLACE})


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

    Raises
    ------
    InputError
        If a place is outside of `PLACE`, or a size outside of `SIZE`, or the side unknown.
    """

    x: float
    width: float
    side: Literal["left", "right"] = "left"
    length: float = 4.0

    def __post_init__(self) -> None:
        require_ranges(self, {"x": PLACE, "width": SIZE, "length": SIZE})
        require_choices(self, {"side": ("left", "right")})


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
        If the width is outside of `SIZE`, a doorway lies outside, or two side
        corridors of one side overlap.
    """

    width: float
    doorways: tuple[Doorway, ...] = ()
    side_corridors: tuple[SideCorridor, ...] = ()

    def __post_init__(self) -> None:
        require_ranges(self, {"width": SIZE})
        require_instances(self, {"doorways": Doorway, "side_corridors": SideCorridor})
        for number, door in enumerate(self.doorways):
            if abs(door.y) + door.width / 2.0 > self.width / 2.0:
                raise InputError(
                    f"doorways.{number} reaches from {door.y - door.width / 2.0:g} to "
                    f"{door.y + door.width / 2.0:g} m, beyond the corridor's {self.width:g} m",
                    ("doorways", number),
                )
        for side in ("left", "right"):
            here = sorted((s.x, s.width) for s in self.side_corridors if s.side == side)
            for (x, width), (next_x, next_width) in itertools.pairwise(here):
                if x + width / 2.0 >= next_x - next_width / 2.0:
                    raise InputError(
                        f"side_corridors: those at x = {x:g} and {next_x:g} m, {side}, overlap",
                        ("side_corridors",),
                    )
