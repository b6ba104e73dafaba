"""Observers: from one negotiation's force and motion to the human's stubbornness and wish."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

from cowalk.sim.basics.motion import Array


@dataclass(frozen=True)
class ForceReading:
    """How a force is to be read.

    Attributes
    ----------
    force_max, force_threshold : ndarray, shape (..., 2)
        Force that counts as full insistence, and below which no wish is read, N.
    sensitivity : ndarray, shape (..., 2)
        Share of the upper bound that a full force asks for, 1.
    lower, upper : ndarray, shape (..., 2)
        Bounds of the twist, m/s and rad/s.
    """

    force_max: Array
    force_threshold: Array
    sensitivity: Array
    lower: Array
    upper: Array


class Estimate(NamedTuple):
    """What an observer makes of a negotiation.

    Attributes
    ----------
    stubbornness : ndarray, shape (..., 2)
        Per dimension, in [0, 1].
    wish : ndarray, shape (..., 2)
        Twist that the human would have, m/s and rad/s, within the bounds.
    """

    stubbornness: Array
    wish: Array


class Observer(Protocol):
    """Takes the force and the executed twist of one negotiation and returns an estimate."""

    def reset(self, reading: ForceReading, twist: Array) -> None:
        """Start an episode from an executed twist, m/s and rad/s, shape (..., 2)."""
        ...

    def update(self, force: Array, twist: Array) -> Estimate:
        """Return the estimate after one more negotiation.

        Parameters
        ----------
        force : ndarray, shape (..., 2)
            Measured force of the human on the base, base axes, N.
        twist : ndarray, shape (..., 2)
            Executed twist, m/s and rad/s.
        """
        ...
