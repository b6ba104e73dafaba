"""A human who now and then adopts the robot's way, and remembers only so much."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import SHARE, require_ranges, require_whole

from ..basics.elementwise import FLOATS, Elementwise, Value
from .intention.intention import Outlook
from .laws.demand import TIME, TOLERANCE, DemandingHuman

MOST_TURNS = 1000
"""Of memory (inferred)."""


@dataclass(kw_only=True)
class BoundedMemoryHuman(DemandingHuman):
    """Keeps their own mode, or adopts the robot's with a probability: their adaptability.

    The bounded-memory adaptation model (Nikolaidis, Hsu and Srinivasa 2017): at each turn, a
    human whose memory of the last k turns holds nothing but disagreement adopts the robot's
    mode with probability alpha. In their own mode they want what their intention wants, in
    the robot's mode they want what is executed. Once k turns have gone by in which the robot
    does what they intend anyway, they are back in their own mode. s = 1 - alpha throughout;
    what moves is the wish. Each dimension has a mode of its own.

    Parameters
    ----------
    adaptability : float
        alpha in [0, 1]; 0, 0.25, 0.5, 0.75 and 1 in Nikolaidis et al. 2017.
    memory : int
        k, 1 to 3 in Nikolaidis et al. 2017.
    turn : float
        Duration of a turn, s. Inferred: a negotiation period.
    tolerance : float
        Disagreement, as a share of the upper bound, up to which they agree. Inferred.
    force_max, gain, intention
        See `DemandingHuman`.

    Raises
    ------
    InputError
        If a parameter is outside the range stated.
    """

    adaptability: float = 0.5
    memory: int = 1
    turn: float = 0.7
    tolerance: float = 0.05

    def __post_init__(self) -> None:
        super().__post_init__()
        require_ranges(self, {"adaptability": SHARE, "tolerance": TOLERANCE}, lanes=True)
        require_ranges(self, {"turn": TIME})
        require_whole("memory", self.memory, 1, MOST_TURNS)

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._rng = rng
        self._steps_per_turn = max(1, round(self.turn / self.period))
        self._step = 0
        self._adopted: list[Value] = [False, False]
        self._turns_disagreed: list[Value] = [0, 0]
        self._turns_agreed: list[Value] = [0, 0]

    def wish(self, outlook: Outlook, observation: Observation) -> tuple[Value, Value]:
        """See `DemandingHuman.wish`."""
        m = outlook.m
        own = self._intention.twist(outlook)
        if self._step > 0 and self._step % self._steps_per_turn == 0:
            lanes = None if m is FLOATS else observation["twist"].shape[:-1]
            for i in range(2):
                self._take_turn(m, i, own[i], self._rng.random(lanes))
        self._step += 1
        return (
            m.where(self._adopted[0], self._executed[0], own[0]),
            m.where(self._adopted[1], self._executed[1], own[1]),
        )

    def stubbornness(self, m: Elementwise, i: int, disagreement: Value) -> Value:
        """See `DemandingHuman.stubbornness`."""
        return 1.0 - self.adaptability

    def _take_turn(self, m: Elementwise, i: int, own: Value, chance: Value) -> None:
        disagree = abs(own - self._executed[i]) > self.tolerance * self._upper[i]
        self._turns_disagreed[i] = m.where(disagree, self._turns_disagreed[i] + 1, 0)
        self._turns_agreed[i] = m.where(disagree, 0, self._turns_agreed[i] + 1)
        adopts = (self._turns_disagreed[i] >= self.memory) & (chance < self.adaptability)
        returns = self._turns_agreed[i] >= self.memory
        stays = m.where(returns, False, self._adopted[i])
        self._adopted[i] = m.where(adopts, True, stays)
