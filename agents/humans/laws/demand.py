"""The definition of stubbornness that every closed-loop human shares, and its force.

A human wants a twist p_H of their own. Their stubbornness s in [0, 1] is the share of the
disagreement that they insist on: they demand s p_H + (1 - s) p_executed, and push in
proportion to what is missing,

    F = F_max sat(gain * s * (p_H - p_executed) / p_ub), per dimension.

s = 0 lets go, s = 1 insists fully. p_H lies within the bounds: what a human asks for beyond
them is insistence, not a wish. Models differ in how s and p_H move.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace

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
        """Return the v and omega wanted, m/s and rad/s: the intention's, unless overridden.

        p_H is what of it lies within the bounds.
        """
        return self._intention.twist(outlook)

    def push(self, m: Elementwise, i: int, demand: Value) -> Value:
        """Return what is pushed for in one dimension: s (p_H - p_executed)/p_ub.

        Overridden by those whose own law goes on where that ends, and by those who are late.

        Parameters
        ----------
        m, i
            See `stubbornness`.
        demand : float, or ndarray of shape (...)
            s (p_H - p_executed)/p_ub now.
        """
        return demand

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        self.period = situation.period
        self._lower = components(situation.bounds.lower)
        self._upper = components(situation.bounds.upper)
        self._executed: tuple[Value, Value] = (0.0, 0.0)
        self._intention = Intention(self.intention, situation)
        self._strength = strength(self.force_max)
        self._truth = unknown(np.zeros(2), self._strength, self.gain)

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        outlook = self._intention.look(observation)
        m, twist = outlook.m, observation["twist"]
        v, omega = self._executed = tuple(m.parts(twist))
        wish_v, wish_omega = self.wish(outlook, observation)
        wish_v = m.clip(wish_v, self._lower[0], self._upper[0])
        wish_omega = m.clip(wish_omega, self._lower[1], self._upper[1])
        missing_v = (wish_v - v) / self._upper[0]
        missing_omega = (wish_omega - omega) / self._upper[1]
        share_v = self.stubbornness(m, 0, missing_v)
        share_omega = self.stubbornness(m, 1, missing_omega)
        self._truth = replace(
            self._truth,
            wish=m.pair(twist, wish_v, wish_omega),
            stubbornness=m.pair(twist, share_v, share_omega),
        )
        push_v = self.push(m, 0, share_v * missing_v)
        push_omega = self.push(m, 1, share_omega * missing_omega)
        return m.pair(
            twist,
            self.force_max[0] * m.clip(self.gain * push_v, -1.0, 1.0),
            self.force_max[1] * m.clip(self.gain * push_omega, -1.0, 1.0),
        )

    def truth(self) -> Truth:
        """See `Human.truth`."""
        return self._truth


def strength(force_max: tuple[Value, Value]) -> Array:
    """Return F_max forward and sideways, N, shape (..., 2)."""
    return np.stack(np.broadcast_arrays(*force_max), axis=-1).astype(float)


def unknown(twist: Array, strength: Array, gain: Value = np.nan) -> Truth:
    """Return the truth of somebody of whom neither wish nor stubbornness is known.

    Parameters
    ----------
    twist : ndarray, shape (..., 2)
        Executed; one human or a batch.
    strength : ndarray, shape (..., 2)
        N.
    gain : float or ndarray, shape (...)
        kappa, 1.
    """
    return Truth(np.full_like(twist, np.nan), np.full_like(twist, np.nan), strength, gain)
