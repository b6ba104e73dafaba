"""A human who plays a linear-quadratic game with the automation, and learns how it plays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import Elementwise, Value, elementwise
from .intention.intention import Outlook
from .laws.demand import REACH, STEERING, Pair
from .laws.linear import LinearHuman
from .laws.lq_game import Gains, best_answer, nash_equilibrium

WEIGHT: Range = (1e-3, 1e3, "")
OBSERVER_RATE: Range = (0.0, 100.0, "1/s")
"""All that matters is how the weights compare (inferred)."""
_QUIET = 0.1
"""Squared error, in upper bounds, below which the observer learns little."""
_LARGEST_GAIN = 5.0
"""Bound of the partner's estimated gains, 1: a learner must survive a partner without a law."""


@dataclass(kw_only=True)
class GameHuman(LinearHuman):
    """u = -L x with L the best answer to the gain that the partner seems to have.

    In each dimension the human sees x = [position error, twist error], in upper bounds of the
    twist, on the plant x_1' = x_2, x_2' = steering (u + u_partner), u = F/F_max, and minimises
    the integral of x'Qx + r u^2 (Li et al. 2019, Nature Machine Intelligence; arXiv 2002.07293).
    The position errors are the bearing of the aim, and how far the base has fallen behind or
    run ahead. They begin in the Nash equilibrium with a partner of the weights they assume. An
    observer corrects the partner's gain by what the twist did beyond the human's own push, and
    they answer it (`cowalk.agents.humans.laws.lq_game`).

    Parameters
    ----------
    error_weights : (float, float)
        Diagonal of Q: position error and twist error. Inferred.
    effort_weight : float
        r. Inferred.
    partner_effort_weight : float
        r that the human assumes of the partner at first, with the same Q. Inferred.
    observer_rate : float
        How fast the partner's gain is corrected, 1/s. Inferred.
    steering : float
        How fast the largest force changes the twist, upper bounds a second. Inferred: the
        shipped drive turns by at most 2 of them a second.
    reach : float
        How far behind or ahead counts, m. Inferred.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    error_weights: Pair = (1.0, 1.0)
    effort_weight: float = 1.0
    partner_effort_weight: float = 1.0
    observer_rate: float = 1.0
    steering: float = 2.0
    reach: float = 0.3

    def __post_init__(self) -> None:
        super().__post_init__()
        require_pairs(self, {"error_weights": WEIGHT})
        weights = {"effort_weight": WEIGHT, "partner_effort_weight": WEIGHT}
        ranges = {"observer_rate": OBSERVER_RATE, "steering": STEERING, "reach": REACH}
        require_ranges(self, weights | ranges)
        first, second = self.error_weights
        efforts = self.effort_weight, self.partner_effort_weight
        self._equilibrium = nash_equilibrium((first, second), efforts, self.steering)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        own, partner = self._equilibrium
        self._gains: list[Gains] = [own, own]
        self._partner: list[Gains] = [partner, partner]
        self._before: list[Gains] = []
        self._pushed: tuple[Value, Value] = (0.0, 0.0)
        self._lag: Value = 0.0

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        force = super().act(observation)
        fx, fy = elementwise(force).parts(force)
        self._pushed = fx / self.force_max[0], fy / self.force_max[1]
        return force

    def content(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `LinearHuman.content`: where -L x is zero."""
        m, pace = outlook.m, outlook.pace
        v, omega = self._executed
        self._lag = m.clip(self._lag + (pace - v) * self.period, -self.reach, self.reach)
        # Who wants to stand does not want to turn.
        bearing = m.where(pace > 0.0, m.atan2(outlook.left, outlook.ahead), 0.0)
        upper_v, upper_omega = self._upper
        errors = [
            (-self._lag / upper_v, (v - pace) / upper_v),
            (-bearing / upper_omega, omega / upper_omega),
        ]
        for i in range(2):
            if self._before:
                self._observe(m, i, self._before[i], errors[i])
            self._gains[i] = best_answer(
                m, self._partner[i], self.error_weights, self.effort_weight, self.steering
            )
        self._before = errors
        (position_v, rate_v), (position_omega, rate_omega) = self._gains
        return pace + position_v / rate_v * self._lag, position_omega / rate_omega * bearing

    def slope(self, i: int) -> Value:
        """See `LinearHuman.slope`: the gain of the twist error."""
        return self._gains[i][1] * self.force_max[i] / self._upper[i]

    def partner_gains(self) -> tuple[Gains, Gains]:
        """Return what the partner's gains in v and in omega seem to be, on x."""
        return self._partner[0], self._partner[1]

    def _observe(self, m: Elementwise, i: int, before: Gains, now: Gains) -> None:
        """Correct the partner's gain by a normalised gradient step on u_partner = -l x."""
        position, rate = self._partner[i]
        push = (now[1] - before[1]) / (self.steering * self.period) - self._pushed[i]
        surprise = push + position * before[0] + rate * before[1]
        size = _QUIET + before[0] * before[0] + before[1] * before[1]
        step = min(self.observer_rate * self.period, 1.0) * surprise / size
        self._partner[i] = (
            m.clip(position - step * before[0], -_LARGEST_GAIN, _LARGEST_GAIN),
            m.clip(rate - step * before[1], -_LARGEST_GAIN, _LARGEST_GAIN),
        )
