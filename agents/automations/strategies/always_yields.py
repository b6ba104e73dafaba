"""The automation that always yields: the other end of the scale."""

from __future__ import annotations

import numpy as np

from cowalk.sim.basics.motion import Array

from .interaction import InteractionStrategy


class AlwaysYields(InteractionStrategy):
    """Executes the human's estimated wish: U_target = 0 (the human leads, as in Boink 2014)."""

    def utility_loss(self, interaction_smoothed: Array) -> Array:
        """See `InteractionStrategy.utility_loss`."""
        return np.ones_like(interaction_smoothed)
