"""McRuer's crossover model: a human who makes the loop with the base an integrator with delay."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

import numpy as np

from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import Elementwise, Value
from .laws.demand import STEERING, DemandingHuman

FREQUENCY: Range = (1e-3, 100.0, "rad/s")
DELAY: Range = (0.0, 5.0, "s")
"""Faster than any hand, and slower than any reaction (inferred)."""


@dataclass(kw_only=True)
class CrossoverHuman(DemandingHuman):
    """Pushes so that Y_p Y_c = omega_c e^(-j omega delay) / (j omega).

    People adjust to what they steer until the loop around them crosses over like this (McRuer
    and Jex 1967). What this human steers is the twist: a push turns the base by a rate of
    change, Y_c = K/(j omega) with K = steering * p_ub/F_max, so that Y_p is a gain with a delay,

        F(t) = (omega_c/K) (p_I - p_executed)(t - delay),

    p_I being what the intention wants. By the common definition that is the wish p_I, held with
    s = omega_c/(gain steering), by a person whose force comes a delay later: `truth` says all
    three. Where s would exceed 1 they insist fully, and push by this law all the same.

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
        past: list[Value] = [0.0] * (steps + 1)
        self._missing = [deque(past, steps + 1), deque(past, steps + 1)]
        self._share = self.crossover_frequency / (self.gain * self.steering)
        self._truth = replace(self._truth, delay=steps * self.period)

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`: omega_c/(gain steering), at most 1."""
        self._missing[i].append(disagreement)
        return m.minimum(self._share, 1.0)

    def push(self, m: Elementwise, i: int, demand: Value) -> Value:
        """See `DemandingHuman.push`: for what was missing a delay ago."""
        return self._share * self._missing[i][0]
