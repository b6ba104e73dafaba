"""Humans whose force is linear in the twist, brought under the common definition.

Their own law says at which twist p_0 they would not push, and how fast the force grows with
the distance from it, F = D (p_0 - p_executed). Beside the common definition,

    F = F_max sat(gain * s * (p_H - p_executed) / p_ub),

that is a human with p_H = p_0 and s = D p_ub / (gain * F_max), as long as p_0 is a twist that
the bounds allow and s is at most 1. A p_0 beyond the bounds is the wish for the bound, held so
much more stubbornly that the force is the same. Who pushes harder than s = 1 allows insists
fully: the force goes on by their own law, and what it has beyond the definition is insistence,
neither wish nor stubbornness (docs/humans.md).
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

from cowalk.sim.basics.observation import Observation

from ...basics.elementwise import Elementwise, Value
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

    def wish(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `DemandingHuman.wish`: p_0."""
        self._content = self.content(outlook, observation)
        return self._content

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`: of the same force by the definition, at most 1."""
        level, wanted, allowed = self._level(i), abs(self._missing(i)), abs(disagreement)
        raised = level * wanted / (allowed + _TINY)
        # Rounding must not raise who wants what is allowed.
        return m.minimum(m.where(wanted > allowed + _TINY, raised, level), 1.0)

    def push(self, m: Elementwise, i: int, demand: Value) -> Value:
        """See `DemandingHuman.push`: by their own law."""
        return self._level(i) * self._missing(i)

    def _level(self, i: int) -> Value:
        """Return D p_ub/(gain F_max), 1."""
        return self.slope(i) * self._upper[i] / (self.gain * self.force_max[i])

    def _missing(self, i: int) -> Value:
        """Return (p_0 - p_executed)/p_ub."""
        return (self._content[i] - self._executed[i]) / self._upper[i]


_TINY = 1e-12
"""Keeps a division finite where the executed twist is at its bound already."""
