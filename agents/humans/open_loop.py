"""The paper's human: a prescribed force, whatever the base does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cowalk.sim.basics.lists import require_pairs, require_rows
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require

from ..basics.protocols import Truth
from .laws.demand import FORCE_MAX, Pair, strength, unknown

SINCE: Range = (0.0, 86400.0, "s")
PUSH: Range = (-1e4, 1e4, "N")
"""Of a profile: more than any hand gives (inferred)."""


@dataclass(kw_only=True)
class OpenLoopHuman:
    """Exerts a force that is a step function of time (arXiv 2407.17275, section IV).

    Nothing in a prescribed force tells what its author wanted: wish and stubbornness are NaN.
    Insistence, the share of their strength, is known.

    Parameters
    ----------
    profile : sequence of (time, fx, fy)
        From each time (s, rising) on, this force (N, base axes) is exerted; 0 N before.
    force_max : (float, float)
        Largest force forward and sideways of the person, N: what insistence refers to.

    Raises
    ------
    InputError
        If the times do not rise, or a number is outside of `SINCE`, `PUSH` or `FORCE_MAX`.
    """

    closed_loop: ClassVar[bool] = False

    profile: tuple[tuple[float, float, float], ...] = ((0.0, 0.0, 0.0),)
    force_max: Pair = (7.5, 7.5)

    def __post_init__(self) -> None:
        require_pairs(self, {"force_max": FORCE_MAX})
        what = "a list of (time, fx, fy) is expected"
        require_rows(self, "profile", (SINCE, PUSH, PUSH), 1, what)
        table = np.asarray(self.profile, dtype=float)
        rising = bool(np.all(np.diff(table[:, 0]) > 0.0))
        what = "each time must be later than the one before"
        require(rising, "profile", self.profile, what)
        self._times = table[:, 0]
        self._forces = np.vstack(([0.0, 0.0], table[:, 1:]))

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        self._strength = strength(self.force_max)
        self._truth = unknown(np.zeros(2), self._strength)

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        # Control times are sums of periods: 12 s must count as 12 s in spite of rounding.
        now = observation["time"][..., 0] + 1e-9
        force = self._forces[np.searchsorted(self._times, now, side="right")]
        self._truth = unknown(observation["twist"], self._strength)
        return np.asarray(force)

    def truth(self) -> Truth:
        """See `Human.truth`."""
        return self._truth
