"""The two protocols a user implements, and what passes between agents and environment.

An agent of yours is any class with these methods; name it ``module:Class`` wherever a name
is accepted. Its constructor's arguments are its parameters in a scenario file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Bounds, Situation

__all__ = ["Automation", "Belief", "Bounds", "Human", "Observation", "Situation", "Truth"]


def _unknown() -> Array:
    return np.full(2, np.nan)


_UNLIMITED = np.full(2, np.inf)
_UNLIMITED.flags.writeable = False


@dataclass(slots=True)
class Truth:
    """What a human model wants, and whose force it is: for the scoring, never the automation.

    Where strength and gain are given, the force is that of the common definition
    (`cowalk.agents.humans.laws.demand`), ``delay`` later and no larger than ``limit``: only then
    can be told in which rows stubbornness is readable from force.

    Attributes
    ----------
    wish : ndarray, shape (..., 2)
        Twist that the human would have, m/s and rad/s, within the situation's bounds; NaN where
        nobody knows it.
    stubbornness : ndarray, shape (..., 2)
        Share of the disagreement that the human insists on, per dimension, in [0, 1]; NaN where
        nobody knows it.
    strength : ndarray, shape (..., 2)
        F_max, the largest force of the person forward and sideways, N; NaN where unknown.
    gain : float or ndarray, shape (...)
        kappa, 1: the share of p_ub that must be missing for full force is 1/kappa; NaN where
        unknown.
    limit : ndarray, shape (..., 2)
        The lowest limit of the force now, N: what fatigue has left, what the hand dares.
    delay : float or ndarray, shape (...)
        Reaction time after which the force follows wish and stubbornness, s.
    """

    wish: Array
    stubbornness: Array
    strength: Array = field(default_factory=_unknown)
    gain: float | Array = np.nan
    limit: Array = field(default_factory=lambda: _UNLIMITED)
    delay: float | Array = 0.0


@dataclass(slots=True)
class Belief:
    """What an automation made of the interaction; NaN where it has no opinion.

    Attributes
    ----------
    stubbornness : ndarray, shape (..., 2)
        Estimated stubbornness per dimension, in [0, 1].
    stubbornness_deviation : ndarray, shape (..., 2)
        Its standard deviation.
    stubbornness_smoothed : ndarray, shape (..., 2)
        The estimate of each negotiation behind the automation's smoother.
    human_wish, human_wish_deviation : ndarray, shape (..., 2)
        Estimated human wish and its standard deviation, m/s and rad/s.
    wish : ndarray, shape (..., 2)
        The automation's own wish, m/s and rad/s.
    interaction, interaction_smoothed : float or ndarray, shape (...)
        Interaction value, in [-2, 2].
    utility_loss, target_utility : float or ndarray, shape (...)
        Conceded and demanded utility, in [0, 1].
    negotiation : int
        Number of negotiations so far.
    extras : mapping of str to float
        A number for each of the automation's ``columns``.
    """

    stubbornness: Array = field(default_factory=_unknown)
    stubbornness_deviation: Array = field(default_factory=_unknown)
    stubbornness_smoothed: Array = field(default_factory=_unknown)
    human_wish: Array = field(default_factory=_unknown)
    human_wish_deviation: Array = field(default_factory=_unknown)
    wish: Array = field(default_factory=_unknown)
    interaction: float | Array = np.nan
    interaction_smoothed: float | Array = np.nan
    utility_loss: float | Array = np.nan
    target_utility: float | Array = np.nan
    negotiation: int = 0
    extras: Mapping[str, float] = field(default_factory=dict)


class Human(Protocol):
    """A model of the human in the human seat."""

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """Start an episode; all randomness comes from ``rng``."""
        ...

    def act(self, observation: Observation) -> Array:
        """Return the intended hand force on the base, base axes, N, shape (..., 2)."""
        ...

    def truth(self) -> Truth:
        """Return the wish and stubbornness behind the last `act`."""
        ...


class Automation(Protocol):
    """The decision maker in the automation seat.

    One that has numbers of its own to log declares them: ``columns``, a mapping from a name to
    its unit. They become columns of the trace, filled from `Belief.extras`.
    """

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """Start an episode; all randomness comes from ``rng``."""
        ...

    def act(self, observation: Observation) -> Array:
        """Return the twist to execute, m/s and rad/s, shape (..., 2)."""
        ...

    def belief(self) -> Belief:
        """Return what the automation believes after the last `act`."""
        ...
