"""Force limit: nobody pushes harder than they can, or dare."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import elementwise
from .wrapper import Imperfection

LIMIT: Range = (1e-3, 1e4, "N")
"""Inferred."""


@dataclass
class ForceLimit(Imperfection):
    """The force asked for, in its direction, up to a limit.

    Parameters
    ----------
    human : Human
    limit : float
        Largest magnitude in N. People communicate with up to 30 N
        (s41598-024-53991-4); a hand led in walking gives about 3 N (fbioe.2025.1622083).

    Raises
    ------
    InputError
        If the limit is outside of `LIMIT`.
    """

    demonstration: ClassVar[tuple[float, float]] = (8.0, 45.0)

    limit: float = 30.0

    def __post_init__(self) -> None:
        super().__post_init__()
        require_ranges(self, {"limit": LIMIT}, lanes=True)

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        m = elementwise(force)
        fx, fy = m.parts(force)
        share = self.limit / m.maximum(m.sqrt(fx * fx + fy * fy), self.limit)
        return m.pair(force, fx * share, fy * share)
