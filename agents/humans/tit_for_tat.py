"""A human who returns what they get: each concession, and each withdrawal, in kind."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.agents.interfaces import Observation, Situation
from cowalk.sim.motion import Array

from .demand import DemandingHuman, Pair, require_positive, require_share
from .elementwise import Elementwise, Value, components


@dataclass(kw_only=True)
class TitForTatHuman(DemandingHuman):
    """Stubbornness mirrors the concession that the automation just made.

    If the automation takes a share c of the disagreement away, the human insists on a share c
    less of what is left; if it moves off again, on as much more:

        s_k = s_{k-1} (1 - c_k),  1 - c_k = |p_H - p_k| / |p_H - p_{k-1}|,

    capped at 1 where it becomes a force, so that a withdrawal taken back leaves no trace.

    The relative tit-for-tat of Faratin, Sierra and Jennings (1998), after Axelrod (1984), and
    the paper's own automation seen from the other side. A wish that moves is no concession:
    both distances are to the present wish.

    Parameters
    ----------
    initial : (float, float)
        Stubbornness in v and in omega before any concession, in (0, 1]. Insisting fully is
        inferred.
    tolerance : float
        Disagreement, as a share of the upper bound, below which nothing counts as conceded or
        withdrawn. Inferred.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    initial: Pair = (1.0, 1.0)
    tolerance: float = 0.05

    def __post_init__(self) -> None:
        super().__post_init__()
        require_share(self, "initial")
        require_positive(self, "initial", "tolerance")

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._level: list[Value] = list(self.initial)
        self._before: tuple[Value, Value] | None = None

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        if self._before is None:
            self._before = components(observation["twist"])
        force = super().act(observation)
        self._before = self._executed
        return force

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        assert self._before is not None
        moved = (self._executed[i] - self._before[i]) / self._upper[i]
        left = m.maximum(abs(disagreement), self.tolerance)
        before = m.maximum(abs(disagreement + moved), self.tolerance)
        # Kept as it is beyond 1, so that a withdrawal and its return cancel out.
        self._level[i] = self._level[i] * left / before
        return m.minimum(self._level[i], 1.0)
