"""What every imperfection shares: it wraps a human and is one itself."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import require_part

from ..basics.protocols import Human, Truth


@dataclass
class Imperfection(ABC):
    """A human whose hand does not do exactly what the human inside asks of it.

    Imperfections nest in any order; the first in a scenario's list is the innermost. They
    change what is felt or what the hand does, never wish, stubbornness or strength: those are of
    the human inside. One that delays or limits the force says so in its truth's ``delay`` or
    ``limit``. Each draws from a generator of its own, spawned from the human's, so that adding
    one leaves the numbers that the human inside draws as they are.

    Parameters
    ----------
    human : Human
        The human inside; in a scenario, the model and the imperfections before this one.

    Attributes
    ----------
    demonstration : (float, float)
        Duration in s and force in N that show this imperfection well, for figures.

    Raises
    ------
    InputError
        If the human inside is none.
    """

    demonstration: ClassVar[tuple[float, float]] = (8.0, 10.0)

    human: Human

    def __post_init__(self) -> None:
        require_part("human", self.human, "a human", ("reset", "act", "truth"))

    @property
    def closed_loop(self) -> bool:
        """Whether the force answers the base's motion: as of the human inside."""
        return getattr(self.human, "closed_loop", True)

    @property
    def broadcasts(self) -> bool:
        """Whether batches of humans are possible: as of the human inside."""
        return getattr(self.human, "broadcasts", True)

    def unsuited(self, plant: str, period: float) -> str | None:
        """Return why this imperfection cannot be used in a scenario, None if it can.

        Parameters
        ----------
        plant : str
            Name of the plant.
        period : float
            Control period, s.
        """
        return None

    @abstractmethod
    def distort(self, force: Array, observation: Observation) -> Array:
        """Return the hand's force.

        Parameters
        ----------
        force : ndarray, shape (..., 2)
            What the human inside asks for, base axes, N.
        observation : Observation

        Returns
        -------
        ndarray, shape (..., 2)
            N.
        """

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        self._rng = rng.spawn(1)[0]
        self.human.reset(rng, situation)

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        return self.distort(self.human.act(observation), observation)

    def truth(self) -> Truth:
        """See `Human.truth`: that of the human inside."""
        return self.human.truth()
