"""A human as a spring and a damper that pull the base along a minimum-jerk movement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.agents.interfaces import Observation, Situation

from .demand import require, require_positive
from .elementwise import Value
from .intention import Outlook
from .linear import LinearHuman


def minimum_jerk(share: Value) -> tuple[Value, Value]:
    """Return how far a minimum-jerk movement of length 1 has come, and its speed.

    Parameters
    ----------
    share : float, or ndarray of shape (...)
        Share s of the duration, in [0, 1].

    Returns
    -------
    (float or ndarray, float or ndarray)
        10 s^3 - 15 s^4 + 6 s^5 (Flash and Hogan 1985) and its derivative.
    """
    square, rest = share * share, 1.0 - share
    return square * share * (10.0 - share * (15.0 - 6.0 * share)), 30.0 * square * rest * rest


@dataclass(kw_only=True)
class ImpedanceHuman(LinearHuman):
    """F = K (x_d - x) + B (x_d' - x'), x_d the minimum-jerk movement that they intend.

    The hand guides a point ahead of the base. Along the base x_d runs at the pace they want,
    as far as the arm reaches; across the path it moves to the offset they aim for with minimum
    jerk, as carrying sideways together does (arXiv 1702.00733).

    Parameters
    ----------
    stiffness : float
        K in N/m; 50 to 300 for the human arm.
    damping : float
        B in N s/m; 5 to 30 for the human arm.
    duration : float
        Time for a movement sideways, s. Inferred.
    lever : float
        Distance of the guided point ahead of the base's centre, m. Inferred.
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
        require_positive(self, "damping", "duration", "lever")
        require(self, "stiffness", self.stiffness >= 0.0, "must not be negative")
        require(self, "reach", self.reach >= 0.0, "must not be negative")

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._lag: Value = 0.0
        self._goal: Value = None
        self._route: Value = 0

    def slope(self, i: int) -> Value:
        """See `LinearHuman.slope`: B, and at the lever's end B * lever."""
        return self.damping if i == 0 else self.damping * self.lever

    def content(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `LinearHuman.content`: x_d' plus K/B of the way that x lies behind x_d."""
        m, pace = outlook.m, outlook.pace
        cos, sin = m.cos(outlook.heading), m.sin(outlook.heading)
        point = outlook.offset + self.lever * sin
        intended, sideways = self._movement(outlook, point)
        ahead = pace * cos + sideways * sin
        left = sideways * cos - pace * sin
        lag = self._lag + (ahead - self._executed[0]) * self.period
        self._lag = m.clip(lag, -self.reach, self.reach)
        rate = self.stiffness / self.damping
        return ahead + rate * self._lag, (left + rate * cos * (intended - point)) / self.lever

    def _movement(self, outlook: Outlook, point: Value) -> tuple[Value, Value]:
        """Return offset and sideways speed of x_d, m and m/s; a new aim starts a new movement."""
        m, aim = outlook.m, outlook.aim
        if self._goal is None:
            self._goal, self._start, self._elapsed = aim + 0.0 * point, point, 0.0 * point
        progress, speed = minimum_jerk(self._elapsed)
        length = self._goal - self._start
        intended = self._start + length * progress
        turned = outlook.route != self._route
        again = (abs(aim - self._goal) > _SAME_AIM) | turned
        self._start = m.where(again, m.where(turned, point, intended), self._start)
        intended = m.where(turned, point, intended)
        speed = m.where(again, 0.0, length * speed / self.duration)
        self._goal = m.where(again, aim, self._goal)
        self._route = outlook.route
        share = m.where(again, 0.0, self._elapsed)
        self._elapsed = m.minimum(share + self.period / self.duration, 1.0)
        return intended, speed


_SAME_AIM = 0.02
"""Aims that differ by less than this are the same movement, m."""
