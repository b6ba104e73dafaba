"""Strategies that give up utility as the paper's smoothed interaction value tells them to."""

from __future__ import annotations

from abc import abstractmethod

import numpy as np

from cowalk.estimation.laws.stubbornness import interaction_value, stubbornness_norm
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.situation import Situation

from ..planner.utility import negotiated
from .negotiation import Agreement, Negotiation
from .part_output import smoothed
from .strategy import Strategy


class InteractionStrategy(Strategy):
    """Concedes utility from a smoothed interaction value (Schneider et al., arXiv 2407.17275).

    I = -2 + 3 ||x|| + U_loss of the negotiation before, smoothed with one value a negotiation;
    a strategy says what loss follows, and the primitive is the one of that utility.

    Parameters
    ----------
    negotiation, front_end, observer, smoother
        See `Strategy`; the smoother smooths the interaction value.
    """

    @abstractmethod
    def utility_loss(self, interaction_smoothed: Array) -> Array:
        """Return the utility that is given up, in [0, 1], shape (...)."""

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Automation.reset`."""
        super().reset(rng, situation)
        self._loss: Array | None = None

    def agree(self, negotiation: Negotiation) -> Agreement:
        """See `Strategy.agree`."""
        if self._loss is None:
            self._loss = np.zeros(negotiation.human.shape[:-1])
            self.smoother.reset(interaction_value(self._loss, self._loss))
        norm = stubbornness_norm(negotiation.stubbornness)
        interaction = interaction_value(norm, self._loss)
        heard = smoothed(self.smoother, interaction)
        self._loss = self.utility_loss(heard)
        target = 1.0 - self._loss
        return Agreement(
            twist=negotiated(negotiation.problem, negotiation.own, negotiation.human, target),
            target_utility=target,
            utility_loss=self._loss,
            interaction=interaction,
            interaction_smoothed=heard,
        )
