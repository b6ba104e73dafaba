"""The definition of stubbornness that every closed-loop human shares, and its force.

A human wants a twist p_H of their own. Their stubbornness s in [0, 1] is the share of the
disagreement that they insist on: they demand s p_H + (1 - s) p_executed, and push in
proportion to what is missing,

    F = F_max sat(gain * s * (p_H - p_executed) / p_ub), per dimension.

s = 0 lets go, s = 1 insists fully. Models differ in how s and p_H move.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field, fields

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation

from ...basics.elementwise import Elementwise, Value, components
from ...basics.protocols import Truth
from ..intention.intention import Intention, IntentionSettings, Outlook

Pair = tuple[float, float]


def require(part: object, name: str, holds: bool, what: str) -> None:
    """Raise `InputError` naming a parameter of a part and its value, unless a condition holds."""
    if not holds:
        raise InputError(f"{name} = {getattr(part, name)}: {what}")


def require_share(part: object, *names: str) -> None:
    """Raise `InputError` unless each of a part's parameters, a number or a pair, is in [0, 1]."""
    for name in names:
        value = np.asarray(getattr(part, name))
        within = bool(((value >= 0.0) & (value <= 1.0)).all())
        require(part, name, within, "must lie in [0, 1]")


def require_positive(part: object, *names: str) -> None:
    """Raise `InputError` unless each of a part's parameters, a number or a pair, is above 0."""
    for name in names:
        require(part, name, bool(np.all(np.asarray(getattr(part, name)) > 0.0)), "must be above 0")


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
    """

    force_max: Pair = (7.5, 7.5)
    gain: float = 2.0
    intention: IntentionSettings = field(default_factory=IntentionSettings)

    def __post_init__(self) -> None:
        for item in fields(self):
            pair = isinstance(item.default, tuple)
            whole = not pair or np.shape(getattr(self, item.name))[:1] == (2,)
            require(self, item.name, whole, "must be two numbers, for v and for omega")
        require_positive(self, "force_max", "gain")

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
