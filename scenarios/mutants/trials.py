"""What a scenario expects, judged with each bad automation and each wrong human."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cowalk.agents.registry import AUTOMATIONS as REGISTERED
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from ..files.building import parameter_names
from ..files.schema import Component, Scenario, with_named, with_part
from ..result import how_it_ended
from ..running.parallel import each_of
from ..running.runner import Progress, run
from .automations import MUTANTS
from .humans import WRONG_HUMANS

SHIPPED = "as it is"
"""The scenario with its own parts."""
PARTS = (SHIPPED, *MUTANTS, *WRONG_HUMANS)


def with_bad_part(scenario: Scenario, name: str) -> Scenario:
    """Return a scenario with one of `PARTS` in the place of its own.

    A bad automation keeps those parameters of the scenario's own that it knows, a wrong human
    is the scenario's own with something wrong.
    """
    if name in WRONG_HUMANS:
        human = scenario.human
        wrong = (Component(name=WRONG_HUMANS[name]), *human.imperfections)
        return scenario.model_copy(
            update={"human": human.model_copy(update={"imperfections": wrong})}
        )
    if name not in MUTANTS:
        return scenario
    known = parameter_names(REGISTERED.get(MUTANTS[name]))
    own = scenario.automation.parameters
    swapped = with_named(scenario, "automation", MUTANTS[name]).automation
    kept = {key: value for key, value in own.items() if key in known}
    return with_part(scenario, "automation", swapped.model_copy(update={"parameters": kept}))


@dataclass(frozen=True)
class Trial:
    """What a scenario's expectations say of one run.

    Attributes
    ----------
    part : str
        One of `PARTS`.
    held : dict of str to bool
        By expectation, in the scenario's order.
    end : str
        How the run ended.
    same : bool
        Whether nothing that was done differs, in any row, from the run as it is: the part makes
        no difference there, or differs in what it reports alone.
    """

    part: str
    held: dict[str, bool]
    end: str
    same: bool


@dataclass(frozen=True)
class Examined:
    """A scenario's expectations, with every part.

    Attributes
    ----------
    scenario : str
    expect : dict of str to str
        Formula by name.
    trials : tuple of Trial
        One for each of `PARTS`.
    """

    scenario: str
    expect: dict[str, str]
    trials: tuple[Trial, ...]

    @property
    def faults(self) -> tuple[str, ...]:
        """What is wrong with the expectations, one line each; none where they discriminate.

        All must hold as it is, each must fail with some bad part, and a parked robot must not
        meet all of them.
        """
        by_part = {trial.part: trial for trial in self.trials}
        failed = [name for name, held in by_part[SHIPPED].held.items() if not held]
        found = [f"{name!r} fails as it is" for name in failed]
        found += [
            f"{name!r} fails with no bad part"
            for name in self.expect
            if all(trial.held[name] for trial in self.trials if trial.part != SHIPPED)
        ]
        if all(by_part["parked"].held.values()):
            found.append("a parked robot meets all of them")
        return tuple(found)


def examine(
    scenarios: Sequence[Scenario],
    progress: Progress | None = None,
    jobs: int = -1,
) -> list[Examined]:
    """Run every scenario as it is, with each bad automation, and with each wrong human.

    Parameters
    ----------
    scenarios : sequence of Scenario
    progress : callable, optional
        Called with the runs done and their total.
    jobs : int
        Processes at once; -1 is one a core.

    Raises
    ------
    InputError
        If a scenario expects nothing, or a run was aborted.
    """
    for scenario in scenarios:
        if not scenario.expect:
            what = "this scenario expects nothing; add formulas that must hold"
            raise InputError(f"{scenario.name}: expect: {what}", ("expect",))
    tasks = [(scenario, part) for scenario in scenarios for part in PARTS]
    found = each_of(_tried, tasks, progress, jobs)
    return [
        _examined(scenario, found[first : first + len(PARTS)])
        for scenario, first in zip(scenarios, range(0, len(found), len(PARTS)), strict=True)
    ]


class _Run(NamedTuple):
    held: dict[str, bool]
    end: str
    done: Array


DONE = ("x", "y", "theta", "v", "omega", "fx", "fy", "fx_intent", "fy_intent")
"""Columns of what was done, not said."""


def _tried(scenario: Scenario, part: str) -> _Run:
    result = run(with_bad_part(scenario, part))
    if result.error is not None:
        raise InputError(f"with {part!r}: {result.error}")
    held = {verdict.name: verdict.passed for verdict in result.verdicts}
    done = np.stack([result.trace[column] for column in DONE])
    return _Run(held, how_it_ended(result.summary), done)


def _examined(scenario: Scenario, runs: Sequence[_Run]) -> Examined:
    as_it_is = runs[PARTS.index(SHIPPED)].done
    trials = [
        Trial(part, each.held, each.end, np.array_equal(each.done, as_it_is))
        for part, each in zip(PARTS, runs, strict=True)
    ]
    return Examined(scenario.name, dict(scenario.expect), tuple(trials))
