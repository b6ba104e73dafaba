"""Bad automations: each is the paper's, spoilt in one way. Two that ship are the ends of the scale.

They take the paper's parameters, so that a scenario's settings hold for them too.
"""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from cowalk.agents.automations.strategies.stubbornness import StubbornnessAutomation
from cowalk.agents.basics.protocols import Belief
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation

PAPER = "stubbornness"
"""The automation that they are compared with."""
MUTANTS = {
    "parked": "cowalk.scenarios.mutants.automations:Parked",
    "never yields": "never-yields",
    "always yields": "always-yields",
    "jitters": "cowalk.scenarios.mutants.automations:Jitters",
    "late": "cowalk.scenarios.mutants.automations:Late",
    "lies": "cowalk.scenarios.mutants.automations:Lies",
}
"""Name of each bad automation, for a scenario."""
JITTER = 0.1
"""Amplitude of what `Jitters` adds to the turn rate, rad/s."""
JITTER_FREQUENCY = 1.0
"""Hz."""
LATENESS = 1.0
"""How old the twist of `Late` is, s."""


class Parked(StubbornnessAutomation):
    """Stands still, whatever it believes and reports.

    Parameters
    ----------
    interaction_min, interaction_max, negotiation, front_end, observer, smoother
        See `StubbornnessAutomation`.
    """

    closed_loop = False

    def act(self, observation: Observation) -> Array:
        """See `Automation.act`."""
        return np.zeros_like(super().act(observation))


class Jitters(StubbornnessAutomation):
    """Shakes its turn rate by 0.1 rad/s at 1 Hz, on top of the paper's twist.

    Parameters
    ----------
    interaction_min, interaction_max, negotiation, front_end, observer, smoother
        See `StubbornnessAutomation`.
    """

    def act(self, observation: Observation) -> Array:
        """See `Automation.act`."""
        phase = math.tau * JITTER_FREQUENCY * observation["time"]
        return super().act(observation) + np.concatenate(
            (np.zeros_like(phase), JITTER * np.sin(phase)), axis=-1
        )


class Late(StubbornnessAutomation):
    """Executes the paper's twist of 1 s ago; until there is one, the first.

    Parameters
    ----------
    interaction_min, interaction_max, negotiation, front_end, observer, smoother
        See `StubbornnessAutomation`.
    """

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Automation.reset`."""
        super().reset(rng, situation)
        self._waiting: deque[Array] = deque(maxlen=round(LATENESS / situation.period) + 1)

    def act(self, observation: Observation) -> Array:
        """See `Automation.act`."""
        self._waiting.append(super().act(observation))
        return self._waiting[0]


class Lies(StubbornnessAutomation):
    """Does what the paper's does, and reports that all agree, in perfect certainty.

    Both wishes are the executed twist, nobody insists, nothing is conceded.

    Parameters
    ----------
    interaction_min, interaction_max, negotiation, front_end, observer, smoother
        See `StubbornnessAutomation`.
    """

    def act(self, observation: Observation) -> Array:
        """See `Automation.act`."""
        self._executed = observation["twist"].copy()
        return super().act(observation)

    def belief(self) -> Belief:
        """See `Automation.belief`."""
        held, nothing = super().belief(), np.zeros_like(self._executed)
        return Belief(
            stubbornness=nothing,
            stubbornness_deviation=nothing,
            stubbornness_smoothed=nothing,
            human_wish=self._executed,
            human_wish_deviation=nothing,
            wish=self._executed,
            interaction=-2.0,
            interaction_smoothed=-2.0,
            utility_loss=0.0,
            target_utility=1.0,
            negotiation=held.negotiation,
            extras=held.extras,
        )
