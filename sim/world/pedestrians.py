"""People who walk through the scene on their own: where one is follows from the time alone."""

from __future__ import annotations

import itertools
import math
from bisect import bisect_right
from dataclasses import dataclass, field

from ..basics.errors import InputError
from ..basics.seats import SEATS, check_seats


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
        If the waypoints, the speed, the radius or the seats make no sense.
    """

    waypoints: tuple[tuple[float, float], ...]
    speed: float = 1.3
    start_time: float = 0.0
    back_and_forth: bool = False
    radius: float = 0.22
    seen_by: tuple[str, ...] = SEATS
    _station: tuple[float, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        station = [0.0]
        for (x, y), (to_x, to_y) in zip(self.waypoints, self.waypoints[1:], strict=False):
            station.append(station[-1] + math.hypot(to_x - x, to_y - y))
        distinct = all(b > a for a, b in itertools.pairwise(station))
        if len(self.waypoints) < 2 or not distinct:
            raise InputError("waypoints: give at least two points, no two in a row the same")
        for name, unit in (("speed", "m/s"), ("radius", "m")):
            if not 0.0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} = {getattr(self, name)} {unit}: it must be above 0")
        if not 0.0 <= self.start_time < math.inf:
            raise InputError(f"start_time = {self.start_time} s: it must be at least 0")
        check_seats(self.seen_by)
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
