"""A human as a spring and a damper that pull the base along a minimum-jerk movement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import Value
from .intention.intention import Outlook
from .intention.minimum_jerk import Movement
from .laws.demand import REACH, TIME
from .laws.linear import LinearHuman

STIFFNESS: Range = (0.0, 1e5, "N/m")
DAMPING: Range = (0.01, 1e5, "N s/m")
LEVER: Range = (0.01, 100.0, "m")
"""From a hand that gives way to one cast in concrete (inferred)."""


@dataclass(kw_only=True)
class ImpedanceHuman(LinearHuman):
    """F = K (x_d - x) + B (x_d' - x'), x_d the minimum-jerk movement that they intend.

    The hand guides a point ahead of the base. Along the base x_d runs at the pace they want,
    as far as the arm reaches; across the path it moves to the offset they aim for with minimum
    jerk, as carrying sideways together does (arXiv 1702.00733). The mass of the hand, 1 to 2 kg,
    is left out: M (x_d'' - x''), 0.2 to 0.4 N for each 0.2 m/s^2, is no function of the twist,
    so that the common definition has no s and p_H for it.

    Parameters
    ----------
    stiffness : float
        K in N/m; 50 to 300 for the human arm.
    damping : float
        B in N s/m; 5 to 30 for the human arm.
    duration : float
        Time for a movement sideways, s. Inferred.
    lever : float
        Distance of the guided point ahead of the base's centre, m. Inferred: as far as the
        intention looks ahead by default, so that the point they pull to the path is the one
        that the others aim at it.
    reach : float
        How far x_d runs ahead of or behind the base, m. Inferred.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    stiffness: float = 50.0
    damping: float = 15.0
    duration: float = 4.0
    lever: float = 1.6
    reach: float = 0.1

    def __post_init__(self) -> None:
        super().__post_init__()
        ranges = {"stiffness": STIFFNESS, "damping": DAMPING, "lever": LEVER}
        require_ranges(self, ranges | {"duration": TIME, "reach": REACH}, lanes=True)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._lag: Value = 0.0
        self._movement: Movement | None = None
        self._route: Value = 0

    def slope(self, i: int) -> Value:
        """See `LinearHuman.slope`: B, and at the lever's end B * lever."""
        return self.damping if i == 0 else self.damping * self.lever

    def content(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `LinearHuman.content`: x_d' plus K/B of the way that x lies behind x_d."""
        m, pace = outlook.m, outlook.pace
        cos, sin = outlook.cos, outlook.sin
        point = outlook.offset + self.lever * sin
        intended, sideways = self._intended(outlook, point)
        ahead = pace * cos + sideways * sin
        left = sideways * cos - pace * sin
        lag = self._lag + (ahead - self._executed[0]) * self.period
        self._lag = m.clip(lag, -self.reach, self.reach)
        rate = self.stiffness / self.damping
        return ahead + rate * self._lag, (left + rate * cos * (intended - point)) / self.lever

    def _intended(self, outlook: Outlook, point: Value) -> tuple[Value, Value]:
        """Return offset and sideways speed of x_d, m and m/s; on another path it starts anew."""
        m = outlook.m
        if self._movement is None:
            self._movement = Movement(point)
        turned = outlook.route != self._route
        if m.any(turned):
            self._movement.rest(m, turned, point)
            self._route = outlook.route
        self._movement.aim(m, outlook.aim)
        intended, speed = self._movement.place(), self._movement.speed()
        self._movement.advance(m, self.period / self.duration)
        return intended, speed / self.duration
