"""What the seats of a run were rewarded for, summed over it."""

from __future__ import annotations

from collections.abc import Mapping

from cowalk.sim.basics.seats import SEATS
from cowalk.sim.env.reward import TERMS


class RewardSum:
    """Rewards of a run so far, by seat and term."""

    def __init__(self) -> None:
        self._sums = {seat: dict.fromkeys(TERMS, 0.0) for seat in SEATS}

    def add(self, terms: Mapping[str, Mapping[str, float]]) -> None:
        """Add a control step's `cowalk.sim.env.env.CowalkEnv.reward_terms`."""
        for seat, sums in self._sums.items():
            for term, value in terms[seat].items():
                sums[term] += value

    def summary(self) -> dict[str, dict[str, float]]:
        """Return the sum of each term by seat, and as ``total`` that of all of them."""
        return {seat: {"total": sum(sums.values()), **sums} for seat, sums in self._sums.items()}
