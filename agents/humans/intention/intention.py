"""Where a human wants to go: path and pace, a way around what they see, changes of mind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from cowalk.sim.basics.errors import InputError, Step
from cowalk.sim.basics.lists import require_entries, require_instances
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.path import PLACE, Path
from cowalk.sim.basics.situation import REACH, Situation
from cowalk.sim.basics.validators import Range, require_instance, require_ranges

from ...basics.elementwise import FLOATS, Elementwise, Value, components, elementwise
from .detour import detour, rows_in_use
from .minimum_jerk import Movement
from .route import Route, Triple

PACE: Range = (0.0, 5.0, "m/s")
"""That anybody may want beside a robot (inferred)."""
RANGES: dict[str, Range] = {
    "pace": PACE,
    "margin": (0.0, 10.0, "m"),
    "anticipation": (0.0, 1000.0, "m"),
    "lookahead": (0.01, 100.0, "m"),
    "easing": (0.01, 100.0, "m"),
}
"""From a hand's breadth to a large hall (inferred)."""
OF_CHANGES: dict[str, Range] = {"at_time": (0.0, 86400.0, "s"), "at_station": PLACE, "pace": PACE}
"""For a day at most (inferred)."""


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
        If a number is outside of `OF_CHANGES`, or the path of another kind; if both or none of
        time and place are given, or nothing changes: every fault.
    """

    at_time: float | None = None
    at_station: float | None = None
    pace: float | None = None
    path: Path | None = None

    def __post_init__(self) -> None:
        faults: list[str] = []
        at: tuple[Step, ...] = ()
        try:
            require_ranges(self, OF_CHANGES)
            if self.path is not None:
                require_instance("path", self.path, Path)
        except InputError as error:
            faults, at = [str(error)], error.at
        if (self.at_time is None) == (self.at_station is None):
            faults.append("give either at_time (s) or at_station (m)")
        if self.pace is None and self.path is None:
            faults.append("nothing changes: give pace (m/s), path, or both")
        if faults:
            raise InputError("; ".join(faults), at)


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
    easing : float
        Distance in m over which their aim moves to the side and back. Inferred: a stride.
    extent : (left, right, behind) or None
        How far base and human together reach from the base's centre, m; None is what the
        situation says of the bodies that walk.
    path : Path or None
        Preferred path, world axes, m; None is the scenario's path.
    changes : sequence of ChangeOfMind
        What they come to want later.

    Raises
    ------
    InputError
        If a number is outside of `RANGES`, the extent not 3 within `REACH`, or a path or a
        change of another kind.
    """

    pace: float | None = None
    margin: float = 0.15
    anticipation: float = 4.0
    lookahead: float = 1.6
    easing: float = 0.8
    extent: tuple[float, float, float] | None = None
    path: Path | None = None
    changes: tuple[ChangeOfMind, ...] = ()

    def __post_init__(self) -> None:
        require_ranges(self, RANGES)
        if self.extent is not None:
            require_entries(self, ("extent",), 3, REACH)
        if self.path is not None:
            require_instance("path", self.path, Path)
        require_instances(self, {"changes": ChangeOfMind})


class Outlook(NamedTuple):
    """What a human makes of an observation.

    Attributes
    ----------
    m : Elementwise
        Functions for the values below: floats, or arrays of shape (...).
    pace : float or ndarray
        Speed they want now, m/s.
    offset : float or ndarray
        Of the base from the path they want now, m.
    cos, sin : float or ndarray
        Of the base's heading against that path.
    aim : float or ndarray
        Offset from that path which they aim for in the end, m.
    ahead, left : float or ndarray
        Where the point they aim at lies now, base axes, m.
    route : int or ndarray
        Which path they want: 0 is the first; it rises with changes of mind.
    """

    m: Elementwise
    pace: Value
    offset: Value
    cos: Value
    sin: Value
    aim: Value
    ahead: Value
    left: Value
    route: Value


class Intention:
    """The twist that a human would have, from where they are and what they see.

    They follow the path they want, walk around the nearest obstacle they see on the side that
    asks for the smaller detour, and steer as a pure pursuit: omega = 2 v sin(alpha) / lookahead,
    alpha the bearing of the aim. The aim moves to the side, and back, with minimum jerk, so
    that the wish never jumps but where they change their mind.

    Parameters
    ----------
    settings : IntentionSettings
    situation : Situation
    """

    def __init__(self, settings: IntentionSettings, situation: Situation) -> None:
        self._settings = settings
        self._pace: Value = situation.pace if settings.pace is None else settings.pace
        extent = situation.extent if settings.extent is None else settings.extent
        self._room = extent, settings.margin, settings.anticipation
        self._lower = components(situation.bounds.lower)
        self._upper = components(situation.bounds.upper)
        # The observation's poses refer to the scenario's path: None stands for it.
        self._known = Route(situation.path)
        self._routes = [None if settings.path is None else Route(settings.path)]
        self._route: Value = 0
        self._needs_world = not self._known.straight or settings.path is not None
        self._changes: list[tuple[ChangeOfMind, int]] = []
        for change in settings.changes:
            if change.path is not None:
                self._routes.append(Route(change.path))
                self._needs_world = True
            self._changes.append((change, len(self._routes) - 1))
        self._made: list[Value] = [False] * len(self._changes)
        self._evasion = Movement(0.0)
        self._easing_share = situation.period / settings.easing  # a walked metre's, times pace

    def wish(self, observation: Observation) -> Array:
        """Return the wanted twist, m/s and rad/s, shape (..., 2)."""
        outlook = self.look(observation)
        return outlook.m.pair(observation["pose"], *self.twist(outlook))

    def twist(self, outlook: Outlook) -> tuple[Value, Value]:
        """Return the wanted v and omega, m/s and rad/s."""
        m, pace, ahead, left = outlook.m, outlook.pace, outlook.ahead, outlook.left
        ahead = m.maximum(ahead, 0.0)  # what lies behind asks for the sharpest turn
        sine = left / m.sqrt(m.maximum(ahead * ahead + left * left, 1e-12))
        omega = (2.0 * pace / self._settings.lookahead) * sine
        (low_v, low_omega), (high_v, high_omega) = self._lower, self._upper
        return m.clip(pace, low_v, high_v), m.clip(omega, low_omega, high_omega)

    def look(self, observation: Observation) -> Outlook:
        """Return where they want to go from here; changes of mind happen in it."""
        pose = observation["pose"]
        m = elementwise(pose)
        known = station, _, _ = tuple(m.parts(pose))
        world = tuple(m.parts(observation["pose_world"])) if self._needs_world else known
        if self._changes:
            self._change_mind(m, observation["time"], station)
        obstacles = rows_in_use(m, observation["obstacles"])
        lookahead = self._settings.lookahead
        if m is FLOATS or len(self._routes) == 1:
            wanted = self._routes[self._route]
            route, relative, axis, goal = self._place(m, wanted, known, world, obstacles)
            aim = self._eased(m, goal)
            ahead, left = route.towards(m, relative, world, axis, lookahead, aim)
            return Outlook(m, self._pace, relative[1], *axis, goal, ahead, left, self._route)
        placed = [self._place(m, route, known, world, obstacles) for route in self._routes]
        goal = self._chosen(m, [there[3] for there in placed])
        aim = self._eased(m, goal)
        seen = [
            (relative[1], *axis, goal, *route.towards(m, relative, world, axis, lookahead, aim))
            for route, relative, axis, _ in placed
        ]
        offset, cos, sin, goal, ahead, left = (
            self._chosen(m, list(values)) for values in zip(*seen, strict=True)
        )
        return Outlook(m, self._pace, offset, cos, sin, goal, ahead, left, self._route)

    def _eased(self, m: Elementwise, goal: Value) -> Value:
        """Return the offset aimed for on the way to a goal, m."""
        self._evasion.aim(m, goal)
        aim = self._evasion.place()
        self._evasion.advance(m, self._pace * self._easing_share)
        return aim

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

    def _chosen(self, m: Elementwise, values: list[Value]) -> Value:
        """Return, of one value for each path, that of the path that everybody wants."""
        chosen = values[0]
        for i, value in enumerate(values[1:], start=1):
            chosen = m.where(self._route == i, value, chosen)
        return chosen

    def _place(
        self,
        m: Elementwise,
        route: Route | None,
        known: Triple,
        world: Triple,
        obstacles: list[Value],
    ) -> tuple[Route, Triple, tuple[Value, Value], Value]:
        """Return a path, the pose against it, the cosine and sine of its heading, the detour."""
        relative = known
        if route is None:
            route = self._known
        else:
            relative = route.relative(m, world)
        _, offset, heading = relative
        axis = m.cos(heading), m.sin(heading)
        if not obstacles:
            return route, relative, axis, 0.0
        return route, relative, axis, detour(m, offset, axis, obstacles, *self._room)
