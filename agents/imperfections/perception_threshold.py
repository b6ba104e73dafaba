"""Perception threshold: differences of force too small to be felt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import Elementwise, Value, elementwise
from .wrapper import Imperfection

RANGES: dict[str, Range] = {"weber": (0.0, 0.99, ""), "threshold": (0.0, 1e3, "N")}
"""At a fraction of 1, hardly anything would ever be felt (inferred)."""


@dataclass
class PerceptionThreshold(Imperfection):
    """Forces that differ by less than a just noticeable difference are the same force.

    A force is held in mind until another differs from it by more than
    max(threshold, weber |F|), F being the one in mind: Weber's law with a floor, as the
    perceptual deadbands of haptic coding have it. It applies to the force that the human
    inside feels (``observation["force"]``, whose mean over the control step counts, and that
    part of ``observation["wrench"]``; torque is felt as it is) and to
    the force of their own hand, which they correct only by what they can feel. The models that
    ship answer the twist, and none reads the force: around them only the second does anything,
    and the twist is perceived as it is. The first is for models of your own that answer what
    they feel.

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
        If a number is outside of `RANGES`.
    """

    weber: float = 0.1
    threshold: float = 0.04

    def __post_init__(self) -> None:
        super().__post_init__()
        require_ranges(self, RANGES, lanes=True)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._felt: tuple[Value, Value] = (0.0, 0.0)
        self._own: tuple[Value, Value] = (0.0, 0.0)

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        force = observation["force"]
        mean = np.add.reduce(force, axis=-2) / force.shape[-2]
        m = elementwise(mean)
        self._felt = self._noticed(m, self._felt, m.parts(mean))
        perceived = observation.copy()
        perceived["force"] = felt = np.empty_like(force)
        felt[...] = m.pair(mean, *self._felt)[..., None, :]
        if "wrench" in observation:
            perceived["wrench"] = observation["wrench"].copy()
            perceived["wrench"][..., :2] = felt
        return self.distort(self.human.act(perceived), observation)

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        m = elementwise(force)
        self._own = self._noticed(m, self._own, m.parts(force))
        return m.pair(force, *self._own)

    def _noticed(
        self, m: Elementwise, held: tuple[Value, Value], force: tuple[Value, Value]
    ) -> tuple[Value, Value]:
        """Return the new force where it can be told from the one held in mind."""
        (held_x, held_y), (x, y) = held, force
        size = held_x * held_x + held_y * held_y
        just_noticeable = m.maximum(self.weber * self.weber * size, self.threshold * self.threshold)
        change_x, change_y = x - held_x, y - held_y
        differs = change_x * change_x + change_y * change_y > just_noticeable
        return m.where(differs, x, held_x), m.where(differs, y, held_y)
