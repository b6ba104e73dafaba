"""What keeps a trace while somebody steps the environment: a run, or a loop of one's own."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.basics.validators import require_instance, require_part
from cowalk.sim.env.env import CowalkEnv

from .columns import all_columns
from .rows import of_belief, of_state, of_truth
from .trace import Trace


class Recorder:
    """Adds a row to a trace after every control step.

    Parameters
    ----------
    env : CowalkEnv
    human : Human
    automation : Automation
        Its ``columns``, if it has any, become columns of the trace.

    Attributes
    ----------
    trace : Trace

    Raises
    ------
    InputError
        If one of them is of another kind, or a column that the automation adds is in the trace
        already.
    """

    def __init__(self, env: CowalkEnv, human: Human, automation: Automation) -> None:
        require_instance("env", env, CowalkEnv, "a CowalkEnv")
        require_part("human", human, "a human", ("reset", "act", "truth"))
        require_part("automation", automation, "an automation", ("reset", "act", "belief"))
        self._env, self._human, self._automation = env, human, automation
        self.added = dict(getattr(automation, "columns", {}))
        """Columns that the automation and its observer add, and their units."""
        self.trace = Trace(all_columns(self.added))
        self._negotiations = 0

    def step(self, rewards: Mapping[str, float], infos: Mapping[str, Mapping[str, Any]]) -> None:
        """Add the row of the control step that `CowalkEnv.step` has just returned from.

        Parameters
        ----------
        rewards, infos : mapping of str to float, and to mapping
            What it returned, by seat.
        """
        belief = self._automation.belief()
        row = dict.fromkeys(self.added, math.nan)
        row |= of_state(self._env)
        row |= of_truth(self._human.truth())
        row |= of_belief(belief)
        row["t"] = (len(self.trace) + 1) / self._env.rates.control
        row["clearance"] = infos["human"]["clearance"]
        row["negotiated"] = float(belief.negotiation > self._negotiations)
        row["reward_human"], row["reward_automation"] = rewards["human"], rewards["automation"]
        for seat, terms in self._env.reward_terms.items():
            row |= {f"reward_{seat}_{term}": value for term, value in terms.items()}
        self._negotiations = belief.negotiation
        self.trace.append(row)
