"""The definition of stubbornness that every closed-loop human shares, and its force.

A human wants a twist p_H of their own. Their stubbornness s in [0, 1] is the share of the
disagreement that they insist on: they demand s p_H + (1 - s) p_executed, and push in
proportion to what is missing,

    F = F_max sat(gain * s * (p_H - p_executed) / p_ub), per dimension.

s = 0 lets go, s = 1 insists fully. Models differ in how s and p_H move.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field

import numpy as np

from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_instance, require_ranges

from ...basics.elementwise import Elementwise, Value, components
from ...basics.protocols import Truth
from ..intention.intention import Intention, IntentionSettings, Outlook

Pair = tuple[float, float]


FORCE_MAX: Range = (1e-3, 1e4, "N")
GAIN: Range = (1e-3, 1e3, "")
TIME: Range = (1e-3, 86400.0, "s")
"""Of what takes a while: from less than a control period to a day."""
TOLERANCE: Range = (1e-6, 10.0, "")
STEERING: Range = (1e-3, 1e3, "1/s")
REACH: Range = (0.0, 10.0, "m")
"""All of these ranges are inferred, and generous."""


@dataclass(kw_only=True)
class DemandingHuman(ABC):
    """A human who pushes for their own wish as far as they are stubborn.

    Parameters
    ----------
    force_max : (float, float)
        Largest force forward and sideways, N. Inferred, as the paper's sideways cap.
    gain : float
        Share of the largest force at full stubbornness and a disagreement as large as the
        upper bound of the twist, 1. Inferred.
    intention : IntentionSettings

    Raises
    ------
    InputError
        If a number is outside of `FORCE_MAX` or `GAIN`, or the intention of another kind.
    """

    force_max: Pair = (7.5, 7.5)
    gain: float = 2.0
    intention: IntentionSettings = field(default_factory=IntentionSettings)

    def __post_init__(self) -> None:
        require_pairs(self, {"force_max": FORCE_MAX})
        require_ranges(self, {"gain": GAIN}, lanes=True)
        require_instance("intention", self.intention, IntentionSettings)

    @abstractmethod
    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """Return this control step's stubbornness in one dimension, in [0, 1].

        Parameters
        ----------
        m : Elementwise
            Functions for this human's or this batch's values.
        i : int
            0 for v, 1 for omega.
        disagreement : float, or ndarray of shape (...)
            (p_H - p_executed) / p_ub in this dimension.
        """

    def wish(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """Return p_H: the v and omega wanted, m/s and rad/s. The intention's, unless overridden."""
        return self._intention.twist(outlook)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        self.period = situation.period
        self._upper = components(situation.bounds.upper)
        self._executed: tuple[Value, Value] = (0.0, 0.0)
        self._intention = Intention(self.intention, situation)
        self._truth = Truth(np.zeros(2), np.zeros(2))

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        outlook = self._intention.look(observation)
        m, twist = outlook.m, observation["twist"]
        v, omega = self._executed = tuple(m.parts(twist))
        wish_v, wish_omega = self.wish(outlook, observation)
        missing_v = (wish_v - v) / self._upper[0]
        missing_omega = (wish_omega - omega) / self._upper[1]
        share_v = self.stubbornness(m, 0, missing_v)
        share_omega = self.stubbornness(m, 1, missing_omega)
        self._truth = Truth(m.pair(twist, wish_v, wish_omega), m.pair(twist, share_v, share_omega))
        return m.pair(
            twist,
            self.force_max[0] * m.clip(self.gain * share_v * missing_v, -1.0, 1.0),
            self.force_max[1] * m.clip(self.gain * share_omega * missing_omega, -1.0, 1.0),
        )

    def truth(self) -> Truth:
        """See `Human.truth`."""
        return self._truth


def prescribed_truth(
    force: Array, twist: Array, upper: Array, force_max: Pair, gain: float
) -> Truth:
    """Return the truth of a human whose force is given and tells no wish.

    It is that of the common definition in a disagreement as large as the force can express:
    s = |F|/F_max, and p_H lies p_ub/gain beyond the executed twist, on the force's side.

    Parameters
    ----------
    force, twist : ndarray, shape (..., 2)
        N; executed, m/s and rad/s.
    upper : ndarray, shape (..., 2)
        Upper bounds of the twist, m/s and rad/s.
    force_max, gain
        See `DemandingHuman`.
    """
    share = np.minimum(np.abs(force) / force_max, 1.0)
    return Truth(twist + np.sign(force) * upper / gain, share)
