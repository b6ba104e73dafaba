"""A human whose stubbornness does not change."""

from __future__ import annotations

from dataclasses import dataclass

from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.validators import SHARE

from ..basics.elementwise import Elementwise, Value
from .laws.demand import DemandingHuman, Pair


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
        require_pairs(self, {"level": SHARE})

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        return self.level[i]
