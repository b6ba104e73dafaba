"""A human who saves effort wherever the error allows it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import SHARE, Range, require_ranges

from ..basics.elementwise import Elementwise, Value
from .laws.demand import TIME, DemandingHuman, Pair

FORGETTING: Range = (0.0, 0.9999, "")
"""Whoever kept all of it would never stop (inferred)."""
LEARNING: Range = (0.0, 100.0, "")
"""At 1 already, a turn is enough (inferred)."""


@dataclass(kw_only=True)
class SlackingHuman(DemandingHuman):
    """Effort is forgotten at a constant rate and renewed by error.

        s_{i+1} = forgetting * s_i + learning * |e_i|,  e = (p_H - p_executed)/p_ub

    for every turn i; within a turn the same law runs continuously. Emken et al. (2007) found
    F_{i+1} = f F_i + g e_i for people whose step a robot assists. Force is proportional to s
    at a given error, so it obeys that law while the error lasts. Where the error ends, so does
    the force, at once: the published decay of the force itself is not reproduced, that of the
    readiness to push is (docs/humans.md).

    Parameters
    ----------
    forgetting : float
        Share f of the effort that is left after a turn without error, in [0, 1). 0.7 to 0.95
        in Emken et al. 2007.
    learning : float
        Effort g that a turn with an error as large as the upper bound adds. Inferred: an error
        of half the bound sustains full stubbornness.
    turn : float
        Duration of a turn, s: one step. Inferred from a step frequency of 1.82 Hz.
    initial : (float, float)
        Stubbornness in v and in omega at the start, in [0, 1]. Inferred.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    forgetting: float = 0.8
    learning: float = 0.4
    turn: float = 0.55
    initial: Pair = (0.3, 0.3)

    def __post_init__(self) -> None:
        super().__post_init__()
        ranges = {"forgetting": FORGETTING, "learning": LEARNING, "turn": TIME}
        require_ranges(self, ranges, lanes=True)
        require_pairs(self, {"initial": SHARE})

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._kept = self.forgetting ** (self.period / self.turn)
        self._added = self.learning * (1.0 - self._kept) / (1.0 - self.forgetting)
        self._level: list[Value] = list(self.initial)

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        level = self._level[i]
        renewed = self._kept * level + self._added * abs(disagreement)
        self._level[i] = m.minimum(renewed, 1.0)
        return level
