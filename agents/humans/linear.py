"""Humans whose force is linear in the twist, brought under the common definition.

Their own law says at which twist p_0 they would not push, and how fast the force grows with
the distance from it, F = D (p_0 - p_executed). Beside the common definition,

    F = F_max sat(gain * s * (p_H - p_executed) / p_ub),

that is a human with p_H = p_0 and s = D p_ub / (gain * F_max). Who would push harder than
s = 1 allows insists fully, on a wish that lies as much farther off (docs/humans.md).
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

from cowalk.agents.interfaces import Observation

from .demand import DemandingHuman
from .elementwise import Elementwise, Value
from .intention import Outlook


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

    def wish(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `DemandingHuman.wish`."""
        m = outlook.m
        content_v, content_omega = self.content(outlook, observation)
        v, omega = self._executed
        return (
            v + m.maximum(self._level(0), 1.0) * (content_v - v),
            omega + m.maximum(self._level(1), 1.0) * (content_omega - omega),
        )

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        return m.minimum(self._level(i), 1.0)

    def _level(self, i: int) -> Value:
        return self.slope(i) * self._upper[i] / (self.gain * self.force_max[i])
