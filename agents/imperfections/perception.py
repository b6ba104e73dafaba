"""Perception threshold: differences of force too small to be felt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.agents.humans.demand import require
from cowalk.agents.interfaces import Observation, Situation
from cowalk.sim.motion import Array

from .wrapper import Imperfection


@dataclass
class PerceptionThreshold(Imperfection):
    """Forces that differ by less than a just noticeable difference are the same force.

    A force is held in mind until another differs from it by more than
    max(threshold, weber |F|), F being the one in mind: Weber's law with a floor, as the
    perceptual deadbands of haptic coding have it. It applies to the force that the human
    inside feels (``observation["force"]``, whose mean over the control step counts) and to
    the force of their own hand, which they correct only by what they can feel.

    Parameters
    ----------
    human : Human
    weber : float
        Weber fraction; 0.08 to 0.13 for force during arm motion (10.1109/TOH.2013.4).
    threshold : float
        Absolute threshold in N; 0.04 (10.1109/TOH.2013.4).

    Raises
    ------
    InputError
        If the fraction is not in [0, 1) or the threshold is negative.
    """

    weber: float = 0.1
    threshold: float = 0.04

    def __post_init__(self) -> None:
        require(self, "weber", 0.0 <= self.weber < 1.0, "must lie in [0, 1)")
        require(self, "threshold", self.threshold >= 0.0, "must not be negative")

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._felt = self._own = np.zeros(2)

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        force = observation["force"]
        self._felt = self._noticed(self._felt, force.mean(axis=-2))
        perceived = observation.copy()
        perceived["force"] = np.broadcast_to(self._felt[..., None, :], force.shape)
        return self.distort(self.human.act(perceived), observation)

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        self._own = self._noticed(self._own, force)
        return self._own.copy()

    def _noticed(self, held: Array, force: Array) -> Array:
        """Return the new force where it can be told from the one held in mind."""
        just_noticeable = np.maximum(self.weber * _size(held), self.threshold)
        return np.where((_size(force - held) > just_noticeable)[..., None], force, held)


def _size(force: Array) -> Array:
    return np.hypot(force[..., 0], force[..., 1])
