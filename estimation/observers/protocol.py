"""Observers: from measured wrench and motion to the human's stubbornness and wish."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.situation import Situation

from .sample import Sample


@dataclass(frozen=True)
class ForceReading:
    """How a negotiating automation is told to read force.

    Attributes
    ----------
    force_max, force_threshold : ndarray, shape (..., 2)
        Force that counts as full insistence, and below which no wish is read, N.
    sensitivity : ndarray, shape (..., 2)
        Share of the upper bound that a full force asks for, 1.
    period : float
        Time between negotiations, the first of which is at the first sample, s.
    window : float
        Time over which force is averaged before it is read, s; 0 is the last control step alone.
    """

    force_max: Array
    force_threshold: Array
    sensitivity: Array
    period: float = 0.7
    window: float = 0.0


class Posterior(Protocol):
    """A joint distribution over stubbornness and wish, for whoever needs more than two moments."""

    def quantile(self, share: float) -> tuple[Array, Array]:
        """Return quantiles of stubbornness and of wish, each dimension alone, shapes (..., 2)."""
        ...

    def sample(self, rng: np.random.Generator, count: int) -> tuple[Array, Array]:
        """Draw stubbornness and wish together, shapes (..., count, 2)."""
        ...

    def wish_at(self, pose: Array) -> Array:
        """Return the expected wish at another world pose, shape (..., 3) to (..., 2)."""
        ...


def _unstated() -> Array:
    return np.full(2, np.nan)


@dataclass(frozen=True, slots=True, eq=False)
class Estimate:
    """What an observer makes of what it has heard (leading batch axes come first).

    Attributes
    ----------
    stubbornness : ndarray, shape (..., 2)
        Mean per dimension, in [0, 1].
    wish : ndarray, shape (..., 2)
        Mean of the twist that the human would have, m/s and rad/s, within the bounds.
    stubbornness_deviation, wish_deviation : ndarray, shape (..., 2)
        Standard deviations; NaN where an observer states none.
    extras : mapping of str to float
        A number for each of the observer's own ``columns``.
    posterior : Posterior, optional
        The whole distribution, where there is one.
    """

    stubbornness: Array
    wish: Array
    stubbornness_deviation: Array = field(default_factory=_unstated)
    wish_deviation: Array = field(default_factory=_unstated)
    extras: Mapping[str, float] = field(default_factory=dict)
    posterior: Posterior | None = None


class Observer(Protocol):
    """Hears every control step and says what it makes of the human.

    An observer that has numbers of its own to log declares them: ``columns``, a mapping from a
    name to its unit. They become columns of the trace. One that does not listen to the force says
    ``reads_force = False``.
    """

    def reset(self, situation: Situation, reading: ForceReading, rng: np.random.Generator) -> None:
        """Start an episode; all randomness comes from ``rng``."""
        ...

    def update(self, sample: Sample, own_wish: Array) -> Estimate:
        """Return the estimate after one more control step.

        Parameters
        ----------
        sample : Sample
            What the front end made of the last control step.
        own_wish : ndarray, shape (..., 2)
            The automation's own wish at the last negotiation, m/s and rad/s.
        """
        ...
