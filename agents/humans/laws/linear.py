"""Humans whose force is linear in the twist, brought under the common definition.

Their own law says at which twist p_0 they would not push, and how fast the force grows with
the distance from it, F = D (p_0 - p_executed). Beside the common definition,

    F = F_max sat(gain * s * (p_H - p_executed) / p_ub),

that is a human with p_H = p_0 and s = D p_ub / (gain * F_max), as long as p_0 is a twist that
the bounds allow and s is at most 1. A wish beyond the bounds is the wish for the bound, held
so much more stubbornly that the force is the same; who would push harder than s = 1 allows
insists fully, on a wish that lies as much farther off (docs/humans.md).
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation

from ...basics.elementwise import Elementwise, Value, components
from ..intention.intention import Outlook
from .demand import DemandingHuman


@dataclass(kw_only=True)
class LinearHuman(DemandingHuman):
    """A human given by the twist at which they do not push, and the slope of their force.

    Parameters
    ----------
    force_max, gain, intention
        See `DemandingHuman`.
    """

    @abstractmethod
    def content(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """Return p_0, the twist at which the human would not push, m/s and rad/s."""

    @abstractmethod
    def slope(self, i: int) -> Value:
        """Return D, force for each unit of v (i = 0, N s/m) or of omega (i = 1, N s/rad)."""

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._lower = components(situation.bounds.lower)
        self._share: list[Value] = [0.0, 0.0]

    def wish(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `DemandingHuman.wish`."""
        v, omega = self.content(outlook, observation)
        return self._equivalent(outlook.m, 0, v), self._equivalent(outlook.m, 1, omega)

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        return self._share[i]

    def _equivalent(self, m: Elementwise, i: int, content: Value) -> Value:
        """Return the wish, and keep the stubbornness, of the same force by the definition."""
        executed = self._executed[i]
        level = self.slope(i) * self._upper[i] / (self.gain * self.force_max[i])
        missing = content - executed
        allowed = m.clip(content, self._lower[i], self._upper[i]) - executed
        beyond = abs(missing) > abs(allowed)
        raised = level * abs(missing) / (abs(allowed) + _TINY)
        self._share[i] = m.minimum(m.where(beyond, raised, level), 1.0)
        return executed + level * missing / self._share[i]


_TINY = 1e-12
"""Keeps a division finite where the executed twist is at its bound already."""
