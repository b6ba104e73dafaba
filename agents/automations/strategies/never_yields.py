"""The automation that never yields: one end of the scale."""

from __future__ import annotations

import numpy as np

from cowalk.sim.basics.motion import Array

from .interaction import InteractionStrategy


class NeverYields(InteractionStrategy):
    """Executes its own wish whatever the human does: U_target = 1."""

    def utility_loss(self, interaction_smoothed: Array) -> Array:
        """See `InteractionStrategy.utility_loss`."""
        return np.zeros_like(interaction_smoothed)
