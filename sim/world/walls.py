"""Walls: of a corridor, with doorways across and side corridors off it, or wherever they stand."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Literal

from ..basics.errors import InputError


def require_positive(thing: object, *names: str) -> None:
    """Refuse sizes of a thing (m) that are not above 0.

    Raises
    ------
    InputError
        With name and value of the first one.
    """
    for name in names:
        value = getattr(thing, name)
        if value is not None and not 0.0 < value < math.inf:
            raise InputError(f"{name} = {value} m: it must be above 0")


@dataclass(frozen=True)
class Wall:
    """A straight wall from one point to another, in m, world axes; ``thickness`` in m."""

    start: tuple[float, float]
    end: tuple[float, float]
    thickness: float = 0.1

    def __post_init__(self) -> None:
        require_positive(self, "thickness")
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
        require_positive(self, "width")


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
        require_positive(self, "width", "length")


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
        require_positive(self, "width")
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
