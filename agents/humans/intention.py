"""Where a human wants to go: path and pace, a way around what they see, changes of mind."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from cowalk.agents.interfaces import Observation, Situation
from cowalk.sim.errors import InputError
from cowalk.sim.motion import Array
from cowalk.sim.path import Path

from .elementwise import FLOATS, Elementwise, Value, components, elementwise
from .route import Route, Triple


@dataclass(frozen=True, kw_only=True)
class ChangeOfMind:
    """From a time or a place on, another pace, another path, or both.

    A pace of 0 is the wish to stop, a low one to slow down, a path the wish to turn off. What
    is left out stays as it was; of two changes of one thing, the one that came last holds.

    Parameters
    ----------
    at_time : float, optional
        Time since the start, s. Either this or ``at_station``.
    at_station : float, optional
        Distance along the scenario's path at which it comes, m.
    pace : float, optional
        Speed preferred from then on, m/s.
    path : Path, optional
        Path preferred from then on, world axes, m.

    Raises
    ------
    InputError
        If both or none of time and place are given, or nothing changes.
    """

    at_time: float | None = None
    at_station: float | None = None
    pace: float | None = None
    path: Path | None = None

    def __post_init__(self) -> None:
        if (self.at_time is None) == (self.at_station is None):
            raise InputError("give either at_time (s) or at_station (m)")
        if self.pace is None and self.path is None:
            raise InputError("nothing changes: give pace (m/s), path, or both")
        if self.at_time is not None and not self.at_time >= 0.0:
            raise InputError(f"at_time = {self.at_time}: must not be negative")
        if self.pace is not None and not self.pace >= 0.0:
            raise InputError(f"pace = {self.pace}: must not be negative; 0 is the wish to stop")


@dataclass(frozen=True)
class IntentionSettings:
    """What a human wants from the walk, shared by every model.

    Parameters
    ----------
    pace : float or None
        Preferred speed in m/s; None is the scenario's pace.
    margin : float
        Distance in m that the human wants between obstacles and both bodies.
    anticipation : float
        Distance in m ahead at which they begin to walk around what they see.
    lookahead : float
        Distance in m ahead of the base at which they aim.
    extent : (float, float)
        How far base and human together reach to the left and to the right of the base's
        centre, m. Inferred from the plants' body sizes.
    path : Path or None
        Preferred path, world axes, m; None is the scenario's path.
    changes : sequence of ChangeOfMind
        What they come to want later.

    Raises
    ------
    InputError
        If a distance or the pace is negative, or the lookahead is 0.
    """

    pace: float | None = None
    margin: float = 0.15
    anticipation: float = 4.0
    lookahead: float = 1.6
    extent: tuple[float, float] = (0.28, 0.87)
    path: Path | None = None
    changes: tuple[ChangeOfMind, ...] = ()

    def __post_init__(self) -> None:
        for name in ("pace", "margin", "anticipation"):
            value = getattr(self, name)
            if value is not None and not value >= 0.0:
                raise InputError(f"{name} = {value}: must not be negative")
        if not self.lookahead > 0.0:
            raise InputError(f"lookahead = {self.lookahead} m: must be above 0")
        if not min(self.extent) >= 0.0:
            raise InputError(f"extent = {self.extent}: neither may be negative")


class Outlook(NamedTuple):
    """What a human makes of an observation.

    Attributes
    ----------
    m : Elementwise
        Functions for the values below: floats, or arrays of shape (...).
    pace : float or ndarray
        Speed they want now, m/s.
    offset, heading : float or ndarray
        Pose of the base against the path they want now, m and rad.
    aim : float or ndarray
        Offset from that path which they aim for, m.
    ahead, left : float or ndarray
        Where the point they aim at lies, base axes, m.
    route : int or ndarray
        Which path they want: 0 is the first; it rises with changes of mind.
    """

    m: Elementwise
    pace: Value
    offset: Value
    heading: Value
    aim: Value
    ahead: Value
    left: Value
    route: Value


class Intention:
    """The twist that a human would have, from where they are and what they see.

    They follow the path they want, walk around the nearest obstacle they see on the side that
    asks for the smaller detour, and steer as a pure pursuit: omega = 2 v sin(alpha) / lookahead,
    alpha the bearing of the aim.

    Parameters
    ----------
    settings : IntentionSettings
    situation : Situation
    """

    def __init__(self, settings: IntentionSettings, situation: Situation) -> None:
        self._settings = settings
        self._pace: Value = situation.pace if settings.pace is None else settings.pace
        self._lower = components(situation.bounds.lower)
        self._upper = components(situation.bounds.upper)
        # The observation's poses refer to the scenario's path: None stands for it.
        self._known = Route(situation.path)
        self._routes = [None if settings.path is None else Route(settings.path)]
        self._route: Value = 0
        self._changes: list[tuple[ChangeOfMind, int]] = []
        for change in settings.changes:
            if change.path is not None:
                self._routes.append(Route(change.path))
            self._changes.append((change, len(self._routes) - 1))
        self._made: list[Value] = [False] * len(self._changes)

    def wish(self, observation: Observation) -> Array:
        """Return the wanted twist, m/s and rad/s, shape (..., 2)."""
        outlook = self.look(observation)
        return outlook.m.pair(observation["pose"], *self.twist(outlook))

    def twist(self, outlook: Outlook) -> tuple[Value, Value]:
        """Return the wanted v and omega, m/s and rad/s."""
        m, pace, ahead, left = outlook.m, outlook.pace, outlook.ahead, outlook.left
        distance = m.sqrt(m.maximum(ahead * ahead + left * left, 1e-12))
        # What lies behind asks for the sharpest turn.
        sine = left / m.where(ahead < 0.0, abs(left) + 1e-12, distance)
        omega = 2.0 * pace * sine / self._settings.lookahead
        (low_v, low_omega), (high_v, high_omega) = self._lower, self._upper
        return m.clip(pace, low_v, high_v), m.clip(omega, low_omega, high_omega)

    def look(self, observation: Observation) -> Outlook:
        """Return where they want to go from here; changes of mind happen in it."""
        pose = observation["pose"]
        m = elementwise(pose)
        known = station, _, _ = tuple(m.parts(pose))
        world = tuple(m.parts(observation["pose_world"]))
        if self._changes:
            self._change_mind(m, observation["time"], station)
        obstacles = _rows(m, observation["obstacles"])
        if m is FLOATS:
            seen = self._follow(m, self._routes[self._route], known, world, obstacles)
        else:
            seen = self._follow(m, self._routes[0], known, world, obstacles)
            for i, route in enumerate(self._routes[1:], start=1):
                other = self._follow(m, route, known, world, obstacles)
                on_it = self._route == i
                seen = tuple(m.where(on_it, b, a) for a, b in zip(seen, other, strict=True))
        offset, heading, aim, ahead, left = seen
        return Outlook(m, self._pace, offset, heading, aim, ahead, left, self._route)

    def _change_mind(self, m: Elementwise, time: Array, station: Value) -> None:
        (now,) = m.parts(time)
        for i, (change, route) in enumerate(self._changes):
            if change.at_time is not None:
                # Control times are sums of periods: 12 s must count as 12 s despite rounding.
                due = now >= change.at_time - 1e-9
            else:
                due = station >= change.at_station
            new = m.where(self._made[i], False, due)
            if change.pace is not None:
                self._pace = m.where(new, change.pace, self._pace)
            if change.path is not None:
                self._route = m.where(new, route, self._route)
            self._made[i] = m.where(due, True, self._made[i])

    def _follow(
        self,
        m: Elementwise,
        route: Route | None,
        known: Triple,
        world: Triple,
        obstacles: list[Value],
    ) -> tuple[Value, ...]:
        """Return offset, heading, aim, ahead and left for one path."""
        relative = known
        if route is None:
            route = self._known
        else:
            relative = route.relative(m, world)
        _, offset, heading = relative
        axis = m.cos(heading), m.sin(heading)
        aim = self._around(m, offset, axis, obstacles) if obstacles else 0.0
        ahead, left = route.towards(m, relative, world, axis, self._settings.lookahead, aim)
        return offset, heading, aim, ahead, left

    def _around(
        self, m: Elementwise, offset: Value, axis: tuple[Value, Value], obstacles: list[Value]
    ) -> Value:
        """Return the offset from the path that clears the nearest obstacle in the way, m."""
        settings = self._settings
        left, right = settings.extent
        behind = max(left, right)
        cos, sin = axis
        aim, nearest = 0.0, math.inf
        for present, x, y, radius in obstacles:
            along = cos * x - sin * y
            across = sin * x + cos * y + offset
            reach = radius + settings.margin
            pass_left, pass_right = across + (reach + right), across - (reach + left)
            in_the_way = (
                (present > 0.0)
                & (along + radius > -behind)
                & (along - radius < settings.anticipation)
                & (pass_left > 0.0)
                & (pass_right < 0.0)
                & (along < nearest)
            )
            # Both detours are open: left is not the longer one.
            detour = m.where(pass_left + pass_right <= 0.0, pass_left, pass_right)
            aim = m.where(in_the_way, detour, aim)
            nearest = m.where(in_the_way, along, nearest)
        return aim


def _rows(m: Elementwise, obstacles: Array) -> list[Value]:
    """Return the rows of the obstacles' observation that are in use, 4 values each."""
    if m is FLOATS:
        return [row[:4] for row in obstacles.tolist() if row[0]]
    rows = []
    for i in range(obstacles.shape[-2]):
        if not obstacles[..., i, 0].any():
            break  # rows in use come first
        # One copy of the row: its values lie far apart in a batch.
        rows.append(m.parts(obstacles[..., i, :4].copy()))
    return rows
