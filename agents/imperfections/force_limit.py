"""Force limit: nobody pushes harder than they can, or dare."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import Elementwise, Value, elementwise
from ..basics.protocols import Truth
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

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._limit = np.full(2, np.inf)

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        m = elementwise(force)
        fx, fy = m.parts(force)
        share = self.limit / m.maximum(m.sqrt(fx * fx + fy * fy), self.limit)
        given = m.pair(force, fx * share, fy * share)
        self._limit = per_direction(m, given, share, self.limit)
        return given

    def truth(self) -> Truth:
        """See `Human.truth`: that of the human inside, whose force is limited."""
        truth = self.human.truth()
        return replace(truth, limit=np.minimum(truth.limit, self._limit))


def per_direction(m: Elementwise, given: Array, share: Value, limit: Value) -> Array:
    """Return the limit of each direction of a force that is limited in size, N, shape (..., 2).

    Parameters
    ----------
    m : Elementwise
    given : ndarray, shape (..., 2)
        What the hand gives, N.
    share : float or ndarray, shape (...)
        Of the force asked for; below 1 where it was cut: what is given is then all there is.
    limit : float or ndarray, shape (...)
        Of its size, N.
    """
    x, y = m.parts(given)
    return m.pair(given, m.where(share < 1.0, abs(x), limit), m.where(share < 1.0, abs(y), limit))
