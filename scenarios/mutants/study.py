"""Every bad automation with a few people, and whether each metric says what was stated of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from ..files.schema import Component, Scenario, with_named
from ..measures.definitions import Definition, definitions
from ..people.loading import load_population
from ..people.person import with_person
from ..running.parallel import each_of
from ..running.runner import Progress, run
from ..studies.side_by_side import numbers_of
from .automations import MUTANTS, PAPER
from .statement import Statement, statements

POPULATION = "healthy-adults"
"""Whom the automations meet besides the scenario's own human."""
FALSE = ("false concession, v", "false concession, omega")
"""Metrics of a walk with somebody who lets go: a person more, for these alone."""
TINY = 1e-12
ALIKE = 0.05
"""Share up to which two values are not told apart."""
HONEST = "paper's"
AUTOMATIONS = {HONEST: PAPER, **MUTANTS}
"""What is run, by the name it has in the table."""


@dataclass(frozen=True)
class Verdict:
    """What a metric said of the bad automations.

    Attributes
    ----------
    metric : str
    values : dict of str to float
        Median over people, by automation; NaN where it applies to nobody.
    worst : tuple of str
        Bad automations that come out worst, and worse than the paper's: several that are `ALIKE`.
    wrong : tuple of str
        What of the statement turned out wrong, and whether lying pays.
    """

    metric: str
    values: dict[str, float]
    worst: tuple[str, ...]
    wrong: tuple[str, ...]


def mutate(
    scenario: Scenario,
    people: int = 6,
    progress: Progress | None = None,
    jobs: int = -1,
) -> dict[str, dict[str, Array]]:
    """Run the paper's and every bad automation with the same people.

    Parameters
    ----------
    scenario : Scenario
        Its own human is the first of them.
    people : int
        People drawn besides (`POPULATION`).
    progress : callable, optional
        Called with the runs done and their total.
    jobs : int
        Processes at once; -1 is one a core.

    Returns
    -------
    dict of str to dict
        By automation, each metric by its name, shape (people,).

    Raises
    ------
    InputError
        If a run was aborted.
    """
    walks = [scenario, *_with_others(scenario, people), _with_nobody(scenario)]
    tasks = [(name, walk) for name in AUTOMATIONS for walk in walks]
    whole = [(with_named(walk, "automation", AUTOMATIONS[name]),) for name, walk in tasks]
    found: dict[str, list[dict[str, float]]] = {name: [] for name in AUTOMATIONS}
    for (name, _), values in zip(tasks, each_of(_measured, whole, progress, jobs), strict=True):
        found[name].append(values)
    return {
        name: {
            metric: np.array([run[metric] for run in (runs[-1:] if metric in FALSE else runs[:-1])])
            for metric in definitions()
        }
        for name, runs in found.items()
    }


def _with_others(scenario: Scenario, people: int) -> Sequence[Scenario]:
    drawn = load_population(POPULATION).draw(people, scenario.seed, scenario.plant.name)
    return [with_person(scenario, person) for person in drawn]


def _with_nobody(scenario: Scenario) -> Scenario:
    """Return a scenario with a human who lets go, and walks: to them nothing is to be conceded."""
    update: dict[str, Any] = {"name": "steady", "parameters": {"level": (0.0, 0.0)}}
    if scenario.plant.name == "unicycle":  # where no body sways
        update["imperfections"] = (Component(name="gait-ripple"),)
    human = scenario.human.model_copy(update=update)
    return scenario.model_copy(update={"human": human})


def _measured(scenario: Scenario) -> dict[str, float]:
    result = run(scenario.model_copy(update={"expect": {}}))
    if result.error is not None:
        raise InputError(f"automation {scenario.automation.name!r}: {result.error}")
    return numbers_of(result)


def judge(found: dict[str, dict[str, Array]], plant: str) -> list[Verdict]:
    """Return what every metric with a direction says, beside what was stated of it.

    Parameters
    ----------
    found : dict of str to dict
        From `mutate`.
    plant : str
        On which they walked: what is stated may depend on it.
    """
    stated = statements(plant)
    return [
        _judged(
            name, definition, stated[name], {each: values[name] for each, values in found.items()}
        )
        for name, definition in definitions().items()
        if definition.worse
    ]


def _judged(
    metric: str, definition: Definition, statement: Statement, values: dict[str, Array]
) -> Verdict:
    middle = {name: _middle(each, definition) for name, each in values.items()}
    bad = {name: _badness(value, definition) for name, value in middle.items()}
    paper = bad[HONEST]
    # Who comes out as the paper's does has not come out worst of anything.
    known = {name: bad[name] for name in MUTANTS if not bad[name] <= paper + TINY}
    known = {name: value for name, value in known.items() if not math.isnan(value)}
    most = max(known.values(), default=math.nan)
    worst = [name for name, value in known.items() if value == most or _alike(value, most)]
    wrong = []
    if statement.worst not in (None, *(worst or [""])):
        wrong.append(f"worst: {' and '.join(worst) or 'none'}")
    wrong += [
        f"sees {name}"
        for name in statement.blind
        if bad[name] > (0.0 if math.isnan(paper) else paper) + ALIKE * abs(paper)
    ]
    if bad["lies"] < paper - TINY or (math.isnan(bad["lies"]) and not math.isnan(paper)):
        wrong.append("lying improves it")
    return Verdict(metric, middle, tuple(worst), tuple(wrong))


def _alike(value: float, most: float) -> bool:
    return math.isfinite(most) and value >= most - ALIKE * abs(most)


def _middle(values: Array, definition: Definition) -> float:
    """Return the median over those to whom a metric applies: people differ more than robots do.

    NaN counts as infinitely bad where it is the worst that there is.
    """
    if definition.missing_is_worst:
        worst = math.inf if definition.worse == "more" else -math.inf
        values = np.where(np.isnan(values), worst, values)
    known = values[~np.isnan(values)]
    return float(np.median(known)) if known.size else math.nan


def _badness(value: float, definition: Definition) -> float:
    if definition.worse == "away from 0":
        return abs(value)
    return -value if definition.worse == "less" else value
