"""Reaction delay: the hand does now what was decided a little while ago."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.protocols import Truth
from .wrapper import Imperfection

DELAY: Range = (0.0, 5.0, "s")
"""Inferred."""


@dataclass
class ReactionDelay(Imperfection):
    """The force of a time ``delay`` ago; nothing before the first one arrives.

    The wish changes at once, the hand follows later. Where the delay is no whole multiple of
    the control period, the force of a control step is the mean of the delayed one over that
    step: the same impulse, spread over two steps.

    Parameters
    ----------
    human : Human
    delay : float
        Reaction time in s. People react to a displaced arm somewhat sooner than to a sound
        or a touch (Chernikoff and Taylor 1952); 0.15 to 0.25 is inferred.

    Raises
    ------
    InputError
        If the delay is negative or longer than 5 s.
    """

    delay: float = 0.2

    def __post_init__(self) -> None:
        super().__post_init__()
        require_ranges(self, {"delay": DELAY})

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        # A delay of 0.15 s is 3 periods of 0.05 s in spite of rounding.
        periods = round(self.delay / situation.period, 9)
        whole = int(periods)
        self._share = periods - whole
        self._newest_first: deque[Array] = deque(maxlen=whole + 2)

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        past = self._newest_first
        if not past:
            past.extend(np.zeros_like(force) for _ in range(past.maxlen or 0))
        past.appendleft(np.array(force))
        if not self._share:
            return past[-2]
        return (1.0 - self._share) * past[-2] + self._share * past[-1]

    def truth(self) -> Truth:
        """See `Human.truth`: that of the human inside, answered so much later."""
        truth = self.human.truth()
        return replace(truth, delay=truth.delay + self.delay)
