"""Muscle fatigue: a force that cannot be held for ever."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_choices, require_ranges

from ..basics.elementwise import Value, elementwise
from ..basics.protocols import Truth
from .force_limit import per_direction
from .wrapper import Imperfection

RATES = {
    "shoulder": (0.0182, 0.00168),
    "elbow": (0.00912, 0.00094),
    "grip": (0.0098, 0.00064),
}
"""Fatigue rate F and recovery rate R in 1/s (Frey-Law, Looft and Heitsman 2012)."""
STRENGTH: Range = (1e-3, 1e4, "N")
"""Inferred."""


@dataclass
class Fatigue(Imperfection):
    """The three-compartment model: motor units are at rest, active or fatigued.

    M_F' = F M_A - R M_F and M_R + M_A + M_F = 1 (Xia and Frey-Law 2008). Units come into
    action within a tenth of a second, in the model as published at a rate of 10/s. Here they
    do so at once, M_A = min(|force|/strength, 1 - M_F), so that fatigue adds no delay of its
    own, and M_F is exact over a control step of constant force. The hand gives
    strength * M_A in the direction asked for. Half of the strength lasts 58 s in the shoulder,
    116 s in the elbow and 106 s in the grip.

    Parameters
    ----------
    human : Human
    muscle : {"shoulder", "elbow", "grip"}
        Whose rates.
    strength : float
        Largest force of the rested arm at the handle, N. Inferred: one hand, standing.

    Attributes
    ----------
    fatigued : float or ndarray, shape (...)
        M_F, share of the motor units that is fatigued now.

    Raises
    ------
    InputError
        If the muscle is unknown or the strength outside of `STRENGTH`.
    """

    demonstration: ClassVar[tuple[float, float]] = (240.0, 30.0)

    muscle: Literal["shoulder", "elbow", "grip"] = "shoulder"
    strength: float = 60.0

    def __post_init__(self) -> None:
        super().__post_init__()
        require_choices(self, {"muscle": RATES})
        require_ranges(self, {"strength": STRENGTH}, lanes=True)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        fatigue, recovery = RATES[self.muscle]
        self._ratio = fatigue / recovery
        self._change = -math.expm1(-recovery * situation.period)
        self.fatigued: Value = 0.0
        self._limit = np.full(2, np.inf)

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        m = elementwise(force)
        fx, fy = m.parts(force)
        asked = m.sqrt(fx * fx + fy * fy) / self.strength
        able = 1.0 - self.fatigued
        # Steady state of M_F for the active units of this step, approached exponentially.
        settled = self._ratio * m.minimum(asked, able)
        fatigued = self.fatigued + self._change * (settled - self.fatigued)
        self.fatigued = m.minimum(fatigued, 1.0)
        share = m.minimum(able / m.maximum(asked, 1e-12), 1.0)
        given = m.pair(force, fx * share, fy * share)
        self._limit = per_direction(m, given, share, self.strength * able)
        return given

    def truth(self) -> Truth:
        """See `Human.truth`: that of the human inside, limited to the force that is left."""
        truth = self.human.truth()
        return replace(truth, limit=np.minimum(truth.limit, self._limit))
