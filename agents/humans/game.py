"""A human who plays a linear-quadratic game with the automation, and learns how it plays."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cowalk.agents.interfaces import Observation, Situation
from cowalk.sim.motion import Array

from .demand import Pair, require, require_positive
from .elementwise import Value
from .intention import Outlook
from .linear import LinearHuman
from .riccati import nash, regulator

_LARGEST_GAIN = 5.0
"""Bound of the partner's estimated gains, 1: a learner must survive a partner without a law."""


@dataclass(kw_only=True)
class GameHuman(LinearHuman):
    """u = -L x with L the best answer to the gain that the partner seems to have.

    In each dimension the human sees x = [position error, twist error], in upper bounds of the
    twist, on the plant x_1' = x_2, x_2' = steering (u + u_partner), u = F/F_max, and minimises
    the integral of x'Qx + r u^2 (Li et al. 2019, Nature Machine Intelligence; arXiv 2002.07293).
    They begin in the Nash equilibrium with a partner of the weights they assume. An observer
    corrects the partner's gain by what the twist did beyond the human's own push, and once a
    turn they answer it: the regulator of A - B L_partner. The position errors are the bearing
    of the aim, and how far the base has fallen behind or run ahead.

    It solves two Riccati equations a turn, so one human costs more than the other models do
    (``python -m benchmarks`` says how much), and humans are stepped one by one.

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
    turn : float
        Time between two answers, s. Inferred: a negotiation period.
    reach : float
        How far behind or ahead counts, m. Inferred.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    broadcasts: ClassVar[bool] = False

    error_weights: Pair = (1.0, 1.0)
    effort_weight: float = 1.0
    partner_effort_weight: float = 1.0
    observer_rate: float = 1.0
    steering: float = 2.0
    turn: float = 0.7
    reach: float = 0.3

    def __post_init__(self) -> None:
        super().__post_init__()
        require_positive(
            self, "error_weights", "effort_weight", "partner_effort_weight", "steering", "turn"
        )
        require(self, "observer_rate", self.observer_rate >= 0.0, "must not be negative")
        require(self, "reach", self.reach >= 0.0, "must not be negative")

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._plant = np.array([[0.0, 1.0], [0.0, 0.0]])
        self._input = np.array([[0.0], [self.steering]])
        self._errors_cost = np.diag(self.error_weights)
        self._effort_cost = np.array([[self.effort_weight]])
        own, partner = nash(
            self._plant,
            self._input,
            (self._errors_cost, self._errors_cost),
            (self._effort_cost, np.array([[self.partner_effort_weight]])),
        )
        self._gains: list[list[float]] = [own[0].tolist()] * 2
        self._partner: list[list[float]] = [partner[0].tolist() for _ in range(2)]
        self._before: list[tuple[float, float]] = []
        self._pushed = (0.0, 0.0)
        self._lag = 0.0
        self._step = 0
        self._steps_per_turn = max(1, round(self.turn / self.period))

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        force = super().act(observation)
        fx, fy = force.tolist()
        self._pushed = fx / self.force_max[0], fy / self.force_max[1]
        return force

    def content(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `LinearHuman.content`: where -L x is zero."""
        (v, omega), pace = self._executed, outlook.pace
        lag = self._lag + (pace - v) * self.period
        self._lag = max(-self.reach, min(self.reach, lag))
        # Who wants to stand does not want to turn.
        bearing = math.atan2(outlook.left, outlook.ahead) if pace > 0.0 else 0.0
        upper_v, upper_omega = self._upper
        self._observe(
            [
                (-self._lag / upper_v, (v - pace) / upper_v),
                (-bearing / upper_omega, omega / upper_omega),
            ]
        )
        if self._step > 0 and self._step % self._steps_per_turn == 0:
            self._gains = [self._answer(partner) for partner in self._partner]
        self._step += 1
        (position_v, rate_v), (position_omega, rate_omega) = self._gains
        return pace + position_v / rate_v * self._lag, position_omega / rate_omega * bearing

    def slope(self, i: int) -> Value:
        """See `LinearHuman.slope`: the gain of the twist error."""
        return self._gains[i][1] * self.force_max[i] / self._upper[i]

    def partner_gains(self) -> Array:
        """Return what the partner's gains seem to be, shape (2, 2): v and omega, on x."""
        return np.array(self._partner)

    def _answer(self, partner: list[float]) -> list[float]:
        left = self._plant - self._input @ np.array([partner])
        gain: list[float] = regulator(left, self._input, self._errors_cost, self._effort_cost)[
            0
        ].tolist()
        return gain

    def _observe(self, errors: list[tuple[float, float]]) -> None:
        """Correct the partner's gain by normalised gradient steps on u_partner = -L x."""
        step = self.observer_rate * self.period
        effect = self.steering * self.period
        for partner, before, now, pushed in zip(
            self._partner, self._before, errors, self._pushed, strict=False
        ):
            push = (now[1] - before[1]) / effect - pushed
            surprise = push + partner[0] * before[0] + partner[1] * before[1]
            size = 0.1 + before[0] ** 2 + before[1] ** 2
            for j in range(2):
                moved = partner[j] - step * surprise * before[j] / size
                partner[j] = max(-_LARGEST_GAIN, min(_LARGEST_GAIN, moved))
        self._before = errors
