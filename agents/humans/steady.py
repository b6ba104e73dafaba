"""A human whose stubbornness does not change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.motion import Array

from .demand import DemandingHuman, Pair, require


@dataclass(kw_only=True)
class SteadyHuman(DemandingHuman):
    """Insists on a constant share of the disagreement, whatever happens.

    Partners in dyads keep their plans unchanged (Takagi et al. 2016, PLoS ONE 0167314).

    Parameters
    ----------
    level : (float, float)
        Stubbornness in v and in omega, in [0, 1].
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If the level is not within [0, 1].
    """

    level: Pair = (0.5, 0.5)

    def __post_init__(self) -> None:
        super().__post_init__()
        require(self, "level", all(0.0 <= s <= 1.0 for s in self.level), "both must lie in [0, 1]")

    def stubbornness(self, disagreement: Array) -> Array:
        """See `DemandingHuman.stubbornness`."""
        return np.broadcast_to(self.level, disagreement.shape)
