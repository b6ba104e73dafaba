"""Wrong humans: each is the scenario's own, wrong in one way.

They are wrappers, as imperfections are, so that every human can be spoilt: whoever walks keeps
their intention, their imperfections and their body.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cowalk.agents.basics.protocols import Truth
from cowalk.agents.imperfections.wrapper import Imperfection
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation

WRONG_HUMANS = {
    "no wish": "cowalk.scenarios.mutants.humans:LetsGo",
    "double strength": "cowalk.scenarios.mutants.humans:TwiceAsStrong",
    "sees nothing": "cowalk.scenarios.mutants.humans:SeesNothing",
}
"""What makes each wrong human of a scenario's own: the innermost of their imperfections."""


@dataclass
class LetsGo(Imperfection):
    """Has no wish of their own: lets go, stubbornness and force are 0.

    Parameters
    ----------
    human : Human
    """

    @property
    def closed_loop(self) -> bool:
        """Whether the force answers the base's motion: it is 0."""
        return False

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        return np.zeros_like(force)

    def truth(self) -> Truth:
        """See `Human.truth`; what nobody knows of the human inside stays unknown."""
        truth = self.human.truth()
        return replace(truth, stubbornness=truth.stubbornness * 0.0)


@dataclass
class TwiceAsStrong(Imperfection):
    """Pushes with twice the force, and has twice the strength.

    Parameters
    ----------
    human : Human
    """

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        return 2.0 * force

    def truth(self) -> Truth:
        """See `Human.truth`."""
        truth = self.human.truth()
        return replace(truth, strength=2.0 * truth.strength)


@dataclass
class SeesNothing(Imperfection):
    """Ignores what they see: to them nothing ever stands in the way.

    Parameters
    ----------
    human : Human
    """

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        nothing = np.zeros_like(observation["obstacles"])
        return self.human.act({**observation, "obstacles": nothing})

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        return force
