"""The definition of stubbornness that every closed-loop human shares, and its force.

A human wants a twist p_H of their own. Their stubbornness s in [0, 1] is the share of the
disagreement that they insist on: they demand s p_H + (1 - s) p_executed, and push in
proportion to what is missing,

    F = F_max sat(gain * s * (p_H - p_executed) / p_ub), per dimension.

s = 0 lets go, s = 1 insists fully. Models differ in how s and p_H move.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field

import numpy as np

from cowalk.agents.interfaces import Observation, Situation, Truth
from cowalk.sim.errors import InputError
from cowalk.sim.motion import Array

from .intention import Intention, IntentionSettings

Pair = tuple[float, float]


def require(part: object, name: str, holds: bool, what: str) -> None:
    """Raise `InputError` naming a parameter of a part and its value, unless a condition holds."""
    if not holds:
        raise InputError(f"{name} = {getattr(part, name)}: {what}")


@dataclass(kw_only=True)
class DemandingHuman(ABC):
    """A human who pushes for their own wish as far as they are stubborn.

    Parameters
    ----------
    force_max : (float, float)
        Largest force forward and sideways, N. Inferred, as the paper's sideways cap.
    gain : float
        Share of the largest force at full stubbornness and a disagreement as large as the
        upper bound of the twist, 1. Inferred.
    intention : IntentionSettings
    """

    force_max: Pair = (7.5, 7.5)
    gain: float = 2.0
    intention: IntentionSettings = field(default_factory=IntentionSettings)

    def __post_init__(self) -> None:
        require(
            self,
            "force_max",
            min(self.force_max) > 0.0,
            "both must be above 0 N",
        )
        require(self, "gain", self.gain > 0.0, "must be above 0")

    @abstractmethod
    def stubbornness(self, disagreement: Array) -> Array:
        """Return this control step's stubbornness, in [0, 1], shape (..., 2).

        Parameters
        ----------
        disagreement : ndarray, shape (..., 2)
            (p_H - p_executed) / p_ub.
        """

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        self.period = situation.period
        self._upper = np.asarray(situation.bounds.upper, dtype=float)
        self._force_max = np.asarray(self.force_max, dtype=float)
        self._intention = Intention(self.intention, situation)
        self._truth = Truth(np.zeros(2), np.zeros(2))

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        wish = self._intention.wish(observation)
        disagreement = (wish - observation["twist"]) / self._upper
        share = self.stubbornness(disagreement)
        self._truth = Truth(wish, share)
        demand = np.clip(self.gain * share * disagreement, -1.0, 1.0)
        return np.asarray(self._force_max * demand)

    def truth(self) -> Truth:
        """See `Human.truth`."""
        return self._truth
