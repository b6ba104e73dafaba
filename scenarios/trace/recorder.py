"""What keeps a trace while somebody steps the environment: a run, or a loop of one's own."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from cowalk.agents.basics.protocols import Automation, Belief, Human, Truth
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
        self._truth: Truth | None = None

    @property
    def person(self) -> dict[str, Any]:
        """Whose force it was, as the human said in the last step; NaN where nobody knows.

        kappa as ``gain``, F_max forward and sideways as ``force_max`` (N), reaction time as
        ``delay`` (s).
        """
        truth = self._truth
        if truth is None:
            return {"gain": math.nan, "force_max": [math.nan, math.nan], "delay": math.nan}
        return {
            "gain": float(truth.gain),
            "force_max": truth.strength.tolist(),
            "delay": float(truth.delay),
        }

    def step(
        self,
        rewards: Mapping[str, float],
        infos: Mapping[str, Mapping[str, Any]],
        truth: Truth | None = None,
        belief: Belief | None = None,
    ) -> None:
        """Add the row of the control step that `CowalkEnv.step` has just returned from.

        Parameters
        ----------
        rewards, infos : mapping of str to float, and to mapping
            What it returned, by seat.
        truth, belief : Truth, Belief, optional
            What human and automation said of the step, if they were asked already.
        """
        truth = self._human.truth() if truth is None else truth
        belief = self._automation.belief() if belief is None else belief
        time = (len(self.trace) + 1) / self._env.rates.control
        row = dict.fromkeys(self.added, math.nan)
        row |= of_state(self._env)
        row |= of_truth(truth, time, self._env)
        row |= of_belief(belief)
        row["t"] = time
        self._truth = truth
        row["clearance"] = infos["human"]["clearance"]
        row["negotiated"] = float(belief.negotiation > self._negotiations)
        row["reward_human"], row["reward_automation"] = rewards["human"], rewards["automation"]
        for seat, terms in self._env.reward_terms.items():
            row |= {f"reward_{seat}_{term}": value for term, value in terms.items()}
        self._negotiations = belief.negotiation
        self.trace.append(row)
