"""A human who returns what they get: each concession, and each withdrawal, in kind."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import Elementwise, Value, components
from .laws.demand import TOLERANCE, DemandingHuman, Pair

INITIAL: Range = (1e-3, 1.0, "")
"""Of nothing there is nothing to give in kind (inferred)."""


@dataclass(kw_only=True)
class TitForTatHuman(DemandingHuman):
    """Stubbornness mirrors the concession that the automation has made in this disagreement.

    What the automation has conceded is how far it moved towards the present wish since the
    disagreement began, as a share of what they would disagree about had it stayed where it was:

        s = s_initial (1 - c),  1 - c = |p_H - p| / |p_H - p_start|, at most 1.

    As long as the wish stands still that is the relative tit-for-tat of Faratin, Sierra and
    Jennings (1998), turn by turn, s_k = s_{k-1} |p_H - p_k| / |p_H - p_{k-1}|, bounded to the
    tactic's range; after Axelrod (1984), and the paper's own automation seen from the other
    side. A wish that moves is no concession: both distances are to the present wish. Once they
    agree, or disagree the other way round, the next disagreement begins anew at s_initial.

    Parameters
    ----------
    initial : (float, float)
        Stubbornness in v and in omega before any concession, in (0, 1]. Insisting fully is
        inferred.
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
    tolerance: float = 0.01

    def __post_init__(self) -> None:
        super().__post_init__()
        require_pairs(self, {"initial": INITIAL})
        require_ranges(self, {"tolerance": TOLERANCE}, lanes=True)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._start: list[Value] | None = None
        self._before: list[Value] = [0.0, 0.0]

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        if self._start is None:
            self._start = list(components(observation["twist"]))
        return super().act(observation)

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        assert self._start is not None
        executed = self._executed[i]
        agree = abs(disagreement) <= self.tolerance
        anew = agree | (disagreement * self._before[i] < 0.0)
        self._start[i] = start = m.where(anew, executed, self._start[i])
        self._before[i] = disagreement
        at_stake = abs(disagreement + (executed - start) / self._upper[i])
        left = m.where(anew, 1.0, abs(disagreement) / m.maximum(at_stake, self.tolerance))
        return m.minimum(self.initial[i] * left, 1.0)
