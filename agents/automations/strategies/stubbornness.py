"""The paper's automation: it concedes as much as the human is stubborn."""

from __future__ import annotations

from cowalk.estimation.front_ends.protocol import FrontEnd
from cowalk.estimation.laws.stubbornness import utility_loss
from cowalk.estimation.observers.protocol import Observer
from cowalk.estimation.smoothers.protocol import Smoother
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.validators import Range, require, require_range

from ..planner.settings import NegotiationSettings
from .interaction import InteractionStrategy

INTERACTION: Range = (-100.0, 100.0, "")
"""Of an interaction value: far beyond what it can be (inferred)."""


class StubbornnessAutomation(InteractionStrategy):
    """Concedes with the smoothed interaction value, so with the human's stubbornness.

    U_target = 1 - (I - I_min)/(I_max - I_min) (Schneider et al., arXiv 2407.17275). With
    I_min = -2 and I_max = 2 it settles at U_target = 1 - ||x||.

    Parameters
    ----------
    interaction_min, interaction_max : float
        Smoothed interaction value at which nothing, and everything, is conceded. Inferred:
        the paper calls them selectable and does not print them.
    negotiation, front_end, observer, smoother
        See `InteractionStrategy`.

    Raises
    ------
    InputError
        If ``interaction_min`` is not below ``interaction_max``, or one outside of `INTERACTION`.
    """

    def __init__(
        self,
        interaction_min: float = -2.0,
        interaction_max: float = 2.0,
        negotiation: NegotiationSettings | None = None,
        front_end: FrontEnd | None = None,
        observer: Observer | None = None,
        smoother: Smoother | None = None,
    ) -> None:
        super().__init__(negotiation, front_end, observer, smoother)
        require_range("interaction_min", interaction_min, INTERACTION)
        require_range("interaction_max", interaction_max, INTERACTION)
        what = f"must lie below interaction_max = {interaction_max}"
        require(interaction_min < interaction_max, "interaction_min", interaction_min, what)
        self._range = (interaction_min, interaction_max)

    def utility_loss(self, interaction_smoothed: Array) -> Array:
        """See `InteractionStrategy.utility_loss`."""
        return utility_loss(interaction_smoothed, *self._range)
