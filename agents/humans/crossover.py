"""McRuer's crossover model: a human who makes the loop with the base an integrator with delay."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import Value
from .intention.intention import Outlook
from .laws.demand import STEERING
from .laws.linear import LinearHuman

FREQUENCY: Range = (1e-3, 100.0, "rad/s")
DELAY: Range = (0.0, 5.0, "s")
"""Faster than any hand, and slower than any reaction (inferred)."""


@dataclass(kw_only=True)
class CrossoverHuman(LinearHuman):
    """Pushes so that Y_p Y_c = omega_c e^(-j omega delay) / (j omega).

    People adjust to what they steer until the loop around them crosses over like this (McRuer
    and Jex 1967). What this human steers is the twist: a push turns the base by a rate of
    change, Y_c = K/(j omega) with K = steering * p_ub/F_max, so that Y_p is a gain with a delay,

        F(t) = (omega_c/K) (p_I - p_executed)(t - delay),

    p_I being what the intention wants.

    `truth` reports the wish p(t) + (p_I - p)(t - delay), at which this human would not push now,
    not p_I: just after p passes p_I the force still points the other way, and no s in [0, 1]
    gives that force with the wish p_I. The two are the same once p has stood still for a delay
    (docs/humans.md says what that means for scoring).

    Parameters
    ----------
    crossover_frequency : float
        omega_c in rad/s; 2 to 5 in McRuer and Jex 1967.
    delay : float
        Effective time delay, s; 0.15 to 0.3 in McRuer and Jex 1967. Rounded to control steps.
    steering : float
        How fast the largest force changes the twist, upper bounds a second. Inferred: the
        shipped drive turns by at most 2 of them a second.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    crossover_frequency: float = 3.0
    delay: float = 0.2
    steering: float = 2.0

    def __post_init__(self) -> None:
        super().__post_init__()
        require_ranges(self, {"crossover_frequency": FREQUENCY, "steering": STEERING}, lanes=True)
        require_ranges(self, {"delay": DELAY})

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        steps = round(self.delay / self.period)
        self._missing: deque[tuple[Value, Value]] = deque([(0.0, 0.0)] * (steps + 1), steps + 1)

    def slope(self, i: int) -> Value:
        """See `LinearHuman.slope`: omega_c/K."""
        return self.crossover_frequency * self.force_max[i] / (self.steering * self._upper[i])

    def content(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `LinearHuman.content`: what was missing a delay ago is wanted on top of now."""
        v, omega = self._executed
        want_v, want_omega = self._intention.twist(outlook)
        self._missing.append((want_v - v, want_omega - omega))
        missing_v, missing_omega = self._missing[0]
        return v + missing_v, omega + missing_omega
