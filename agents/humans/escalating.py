"""A human who insists more and more while nobody gives way, and relaxes when met."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import SHARE, Range, require, require_ranges

from ..basics.elementwise import Elementwise, Value
from .laws.demand import TIME, TOLERANCE, DemandingHuman, Pair

LEAST = 1e-3
"""Stubbornness that grows within a walk (inferred)."""
GROWTH: Range = (0.0, 100.0, "")
HOLD: Range = (0.0, 86400.0, "s")
"""A hundredfold a turn, and a day (inferred)."""


@dataclass(kw_only=True)
class EscalatingHuman(DemandingHuman):
    """Stubbornness rises with unresolved disagreement and decays when the human is met.

    Unresolved, s grows by a share each turn; met, it returns to its initial value,

        ds/dt = u s ln(1 + growth)/turn - (1 - u) (s - s_initial)/relaxation,

    u = min(|disagreement|/tolerance, 1) being how unresolved it is. Pairs of people told to
    return each other's force escalate by 38 % a turn, from 0.25 N by 3.2 N over eight turns
    (Shergill et al. 2003, at the fingertip). In a lasting disagreement this human's force does.
    Corrections of a robot arm show longer persistence rather than harder pushes; growth = 0
    with a long hold is that.

    Parameters
    ----------
    initial : (float, float)
        Stubbornness in v and in omega at the start and when met, in (0, 1]: what is 0 never
        grows. Inferred.
    growth : float
        Growth a turn of unresolved disagreement, 0.38 from Shergill et al. 2003.
    turn : float
        Duration of a turn, s. Inferred: in the experiment each pressed for 3 s in turn; who walks
        hand in hand need not wait for the other.
    hold : float
        Time for which stubbornness stays up after the human is met, s. Inferred.
    relaxation : float
        Time constant of the decay, s. Inferred.
    tolerance : float
        Disagreement, as a share of the upper bound, that counts as wholly unresolved. Inferred.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    initial: Pair = (0.3, 0.3)
    growth: float = 0.38
    turn: float = 2.0
    hold: float = 0.0
    relaxation: float = 3.0
    tolerance: float = 0.2

    def __post_init__(self) -> None:
        super().__post_init__()
        require_pairs(self, {"initial": SHARE})
        what = f"must be {LEAST:g} or more, since what is 0 never grows; try 0.01"
        require(min(map(np.min, self.initial)) >= LEAST, "initial", self.initial, what)
        require_ranges(self, {"growth": GROWTH, "turn": TIME, "relaxation": TIME})
        require_ranges(self, {"hold": HOLD, "tolerance": TOLERANCE}, lanes=True)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._growth = math.log1p(self.growth) * self.period / self.turn
        self._decay = -math.expm1(-self.period / self.relaxation)
        self._level: list[Value] = list(self.initial)
        self._since_unresolved: list[Value] = [math.inf, math.inf]

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        unresolved = m.minimum(abs(disagreement) / self.tolerance, 1.0)
        since = m.where(unresolved >= 1.0, 0.0, self._since_unresolved[i] + self.period)
        relaxing = (1.0 - unresolved) * (since > self.hold)
        level = self._level[i] * m.exp(self._growth * unresolved)
        level = level - self._decay * relaxing * (level - self.initial[i])
        self._since_unresolved[i] = since
        self._level[i] = m.minimum(level, 1.0)
        return self._level[i]
