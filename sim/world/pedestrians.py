"""People who walk through the scene on their own: where one is follows from the time alone."""

from __future__ import annotations

import itertools
import math
from bisect import bisect_right
from dataclasses import dataclass, field

from ..basics.lists import require_rows
from ..basics.path import PLACE
from ..basics.seats import SEATS, require_seats
from ..basics.validators import Range, refusal, require_flag, require_ranges

RANGES: dict[str, Range] = {
    "speed": (0.01, 10.0, "m/s"),
    "start_time": (0.0, 86400.0, "s"),
    "radius": (0.01, 5.0, "m"),
}
"""From a child that dawdles to a runner with a bed (inferred)."""


@dataclass(frozen=True)
class Pedestrian:
    """Somebody who walks along waypoints at a constant speed and gives way to nobody.

    Parameters
    ----------
    waypoints : sequence of (x, y)
        At least two distinct consecutive points in m, world axes.
    speed : float
        Walking speed, m/s. People walk at 1.3 m/s on their own (Bohannon 1997, 1.27 to 1.46 m/s
        for adults below 70).
    start_time : float
        When they leave the first waypoint, s; until then they stand there.
    back_and_forth : bool
        Turn round at either end, for ever; else they stop at the last waypoint.
    radius : float
        Radius in m.
    seen_by : tuple of str
        Seats that perceive them when in sight.

    Raises
    ------
    InputError
        If there are fewer than two waypoints, one is not two numbers within `PLACE`, two in a
        row are the same, a number is outside of `RANGES`, or a seat is unknown.
    """

    waypoints: tuple[tuple[float, float], ...]
    speed: float = 1.3
    start_time: float = 0.0
    back_and_forth: bool = False
    radius: float = 0.22
    seen_by: tuple[str, ...] = SEATS
    _station: tuple[float, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        what = "give at least two points, no two in a row the same"
        require_rows(self, "waypoints", (PLACE, PLACE), 2, what)
        require_ranges(self, RANGES)
        require_flag("back_and_forth", self.back_and_forth)
        require_seats(self)
        station = [0.0]
        for (x, y), (to_x, to_y) in itertools.pairwise(self.waypoints):
            station.append(station[-1] + math.hypot(to_x - x, to_y - y))
        if not all(b > a for a, b in itertools.pairwise(station)):
            raise refusal("waypoints", self.waypoints, what)
        object.__setattr__(self, "_station", tuple(station))

    def state(self, time: float) -> tuple[float, float, float, float]:
        """Return ``(x, y, vx, vy)`` at a time since reset, world axes, m and m/s."""
        length = self._station[-1]
        walked = self.speed * (time - self.start_time)
        speed = self.speed
        if walked <= 0.0:
            walked, speed = 0.0, 0.0
        elif self.back_and_forth:
            walked %= 2.0 * length
            if walked > length:
                walked, speed = 2.0 * length - walked, -speed
        elif walked >= length:
            walked, speed = length, 0.0
        leg = min(bisect_right(self._station, walked), len(self._station) - 1) - 1
        (x, y), (to_x, to_y) = self.waypoints[leg], self.waypoints[leg + 1]
        whole = self._station[leg + 1] - self._station[leg]
        along_x, along_y = (to_x - x) / whole, (to_y - y) / whole
        way = walked - self._station[leg]
        return x + way * along_x, y + way * along_y, speed * along_x, speed * along_y
