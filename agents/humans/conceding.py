"""A human who gives way with time, whatever the automation does."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import SHARE, Range, require_ranges

from ..basics.elementwise import Elementwise, Value
from .laws.demand import TIME, TOLERANCE, DemandingHuman, Pair

BETA: Range = (1e-3, 1e3, "")
"""From holding out to the last moment to conceding at once (inferred)."""


@dataclass(kw_only=True)
class ConcedingHuman(DemandingHuman):
    """Stubbornness falls with the time for which the two have disagreed.

        s(t) = final + (initial - final) (1 - min(t/deadline, 1)^(1/beta))

    The polynomial time-dependent tactic of Faratin, Sierra and Jennings (1998), in shared
    control Rothfuß et al. (2020, 10.1109/SMC42975.2020.9282813): beta < 1 holds out until the
    deadline (Boulware), beta > 1 concedes at once (conceder). The clock runs in each dimension
    while they disagree there, and a new disagreement is a new negotiation.

    Parameters
    ----------
    initial, final : (float, float)
        Stubbornness in v and in omega when a disagreement begins, and from the deadline on,
        in [0, 1]. Insisting fully and letting go are the ends of the published tactic.
    beta : float
        Below 1 Boulware, 1 linear, above 1 conceder. 0.5 is inferred.
    deadline : float
        Time after which nothing more is conceded, s. Inferred.
    tolerance : float
        Disagreement, as a share of the upper bound, up to which they agree. Inferred.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    initial: Pair = (1.0, 1.0)
    final: Pair = (0.0, 0.0)
    beta: float = 0.5
    deadline: float = 10.0
    tolerance: float = 0.05

    def __post_init__(self) -> None:
        super().__post_init__()
        require_pairs(self, {"initial": SHARE, "final": SHARE})
        ranges = {"beta": BETA, "deadline": TIME, "tolerance": TOLERANCE}
        require_ranges(self, ranges, lanes=True)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._elapsed: list[Value] = [0.0, 0.0]

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        disagree = abs(disagreement) > self.tolerance
        elapsed = m.where(disagree, self._elapsed[i], 0.0)
        conceded = m.minimum(elapsed / self.deadline, 1.0) ** (1.0 / self.beta)
        self._elapsed[i] = m.where(disagree, elapsed + self.period, 0.0)
        return self.initial[i] + (self.final[i] - self.initial[i]) * conceded
