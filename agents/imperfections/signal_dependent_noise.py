"""Signal-dependent motor noise: the harder the push, the less exact."""

from __future__ import annotations

from dataclasses import dataclass

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.validators import SHARE, require_ranges

from .wrapper import Imperfection


@dataclass
class SignalDependentNoise(Imperfection):
    """Gaussian noise whose standard deviation grows with the force: sigma = share |F|.

    Drawn anew each control step, for each direction by the force in that direction. That the
    noise of a force grows with it: Jones, Hamilton and Wolpert (2002), J. Neurophysiol. 88:1533.

    Parameters
    ----------
    human : Human
    share : float
        Standard deviation as a share of the force. Inferred: 0.02 to 0.05.

    Raises
    ------
    InputError
        If the share is not in [0, 1].
    """

    share: float = 0.03

    def __post_init__(self) -> None:
        super().__post_init__()
        require_ranges(self, {"share": SHARE}, lanes=True)

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        return force * (1.0 + self.share * self._rng.standard_normal(force.shape))
