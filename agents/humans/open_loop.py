"""The paper's human: a prescribed force, whatever the base does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation

from ..basics.protocols import Truth
from .laws.demand import Pair, prescribed_truth, require, require_positive


@dataclass(kw_only=True)
class OpenLoopHuman:
    """Exerts a force that is a step function of time (arXiv 2407.17275, section IV).

    Nothing in a prescribed force tells what its author wanted: its truth is that of
    `cowalk.agents.humans.laws.demand.prescribed_truth`.

    Parameters
    ----------
    profile : sequence of (time, fx, fy)
        From each time (s, rising) on, this force (N, base axes) is exerted; 0 N before.
    force_max : (float, float)
        Force forward and sideways that counts as full stubbornness, N.
    gain : float
        As in the common definition, 1.

    Raises
    ------
    InputError
        If the times do not rise, or ``force_max`` or ``gain`` is not above 0.
    """

    closed_loop: ClassVar[bool] = False

    profile: tuple[tuple[float, float, float], ...] = ((0.0, 0.0, 0.0),)
    force_max: Pair = (7.5, 7.5)
    gain: float = 2.0

    def __post_init__(self) -> None:
        require_positive(self, "force_max", "gain")
        table = np.asarray(self.profile, dtype=float).reshape(-1, 3)
        rising = bool(np.all(np.diff(table[:, 0]) > 0.0))
        require(self, "profile", rising, "each time must be later than the one before")
        self._times = table[:, 0]
        self._forces = np.vstack(([0.0, 0.0], table[:, 1:]))

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        self._upper = np.asarray(situation.bounds.upper, dtype=float)
        self._truth = Truth(np.zeros(2), np.zeros(2))

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        # Control times are sums of periods: 12 s must count as 12 s in spite of rounding.
        now = observation["time"][..., 0] + 1e-9
        force = self._forces[np.searchsorted(self._times, now, side="right")]
        self._truth = prescribed_truth(
            force, observation["twist"], self._upper, self.force_max, self.gain
        )
        return np.asarray(force)

    def truth(self) -> Truth:
        """See `Human.truth`."""
        return self._truth
