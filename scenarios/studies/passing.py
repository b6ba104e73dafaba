"""The share of people who meet a scenario's expectations, with one automation and with another."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cowalk.estimation.scores.people import LEVEL, Interval, People, bootstrap
from cowalk.sim.basics.errors import InputError

from ..files.schema import Scenario, with_named
from ..people.person import Person, with_person
from ..people.population import Population
from ..result import how_it_ended
from ..running.parallel import each_of
from ..running.runner import Progress, run

REFERENCE = "never-yields"
"""The automation beside the scenario's own, which concedes nothing."""
UNBUILT = "cannot be built"
"""How the run of a person ends with whom there is none."""


class Outcome(NamedTuple):
    """What became of one person with one automation.

    Attributes
    ----------
    passed : bool
        Whether the run went through and every expectation held.
    failed : tuple of str
        Expectations that did not hold.
    end : str
        How the run ended, with the reason where it was aborted or could not be built.
    """

    passed: bool
    failed: tuple[str, ...]
    end: str


@dataclass(frozen=True)
class Share:
    """How people fared with one automation.

    Attributes
    ----------
    automation : str
    passed, people : int
    share : Interval
        Of people who passed, by Wilson's interval: one of nobody in 40 is not 0 to 0.
    failed : dict of str to int
        People for whom each expectation of the scenario did not hold.
    ends : dict of str to int
        People by how their run ended, the most frequent first.
    outcomes : tuple of Outcome
        One a person, in the order in which they were drawn.
    """

    automation: str
    passed: int
    people: int
    share: Interval
    failed: dict[str, int]
    ends: dict[str, int]
    outcomes: tuple[Outcome, ...]


@dataclass(frozen=True)
class Passes:
    """How the people of a population fared in a scenario.

    Attributes
    ----------
    scenario, population, plant : str
    seed : int
        Of the draw.
    drawn : tuple of Person
    shares : tuple of Share
        One an automation; the first is what the others are compared with.
    differences : dict of str to Interval
        Share with the first automation less that with another, over the same people.
    """

    scenario: str
    population: str
    plant: str
    seed: int
    drawn: tuple[Person, ...]
    shares: tuple[Share, ...]
    differences: dict[str, Interval]


def people_who_pass(
    scenario: Scenario,
    population: Population,
    people: int = 40,
    seed: int | None = None,
    automations: Sequence[str] = (),
    progress: Progress | None = None,
    jobs: int = -1,
) -> Passes:
    """Let everybody walk through a scenario with each of several automations.

    The world is the scenario's own, since its expectations are written for it. Each person has
    a seed of their own, the scenario's and the ones that follow it: body, gait and all noise
    are the same with every automation.

    Parameters
    ----------
    scenario : Scenario
    population : Population
    people : int
    seed : int, optional
        Of the draw; the scenario's unless given.
    automations : sequence of str
        The scenario's own and `REFERENCE` unless given. The scenario's own keeps its parameters.
    progress : callable, optional
        Called with the runs done and their total.
    jobs : int
        Processes at once; -1 is one a core.

    Raises
    ------
    InputError
        If the scenario expects nothing, there are not at least two people, or an automation is
        unknown. A run that is aborted, or that cannot be built with somebody, is somebody who
        did not pass.
    """
    if not scenario.expect:
        what = "this scenario expects nothing; add formulas that must hold"
        raise InputError(f"expect: {what}", ("expect",))
    if people < 2:
        raise InputError(f"people = {people}: an interval needs at least 2", ("people",))
    names = list(dict.fromkeys(automations or (scenario.automation.name, REFERENCE)))
    with_each = [with_named(scenario, "automation", name) for name in names]
    for name, chosen in zip(names, with_each, strict=True):
        _require_automation(name, chosen)
    seed = scenario.seed if seed is None else seed
    drawn = population.draw(people, seed, scenario.plant.name)
    tasks = [
        (chosen.model_copy(update={"seed": scenario.seed + number}), person)
        for number, person in enumerate(drawn)
        for chosen in with_each
    ]
    outcomes = each_of(_walk, tasks, progress, jobs)
    by_automation = [outcomes[index :: len(names)] for index in range(len(names))]
    shares = tuple(
        _share(name, tuple(of_one), scenario)
        for name, of_one in zip(names, by_automation, strict=True)
    )
    passed = np.array([[float(o.passed) for o in of_one] for of_one in by_automation]).T
    everybody = People(passed, np.full(people, population.name))
    differences = {
        name: bootstrap(everybody, lambda means, i=index: means[..., 0] - means[..., i])  # type: ignore[misc]
        for index, name in enumerate(names)
        if index
    }
    return Passes(
        scenario.name,
        population.name,
        scenario.plant.name,
        seed,
        tuple(drawn),
        shares,
        differences,
    )


def _require_automation(name: str, scenario: Scenario) -> None:
    """Refuse what cannot be built whoever walks."""
    from ..files.assembling import build_part

    try:
        build_part(scenario, "automation")
    except InputError as error:
        raise InputError(f"automation {name!r}: {error}", error.at) from error


def _walk(scenario: Scenario, person: Person) -> Outcome:
    try:
        result = run(with_person(scenario, person))
    except InputError as error:
        return Outcome(False, (), f"{UNBUILT}: {error}")
    failed = tuple(verdict.name for verdict in result.verdicts if not verdict.passed)
    if result.error is None:
        return Outcome(result.passed, failed, how_it_ended(result.summary))
    reason = _WHEN.sub("", result.error).removeprefix(f"{scenario.name}: ")
    return Outcome(False, failed, f"aborted: {reason}")


_WHEN = re.compile(r" at t = [0-9.e+-]+ s")
"""Differs from person to person, where the reason does not."""


def _share(automation: str, outcomes: tuple[Outcome, ...], scenario: Scenario) -> Share:
    from scipy.stats import binomtest  # slow to import

    passed, people = sum(outcome.passed for outcome in outcomes), len(outcomes)
    low, high = binomtest(passed, people).proportion_ci(LEVEL, method="wilson")
    failed = Counter(name for outcome in outcomes for name in outcome.failed)
    return Share(
        automation,
        passed,
        people,
        Interval(passed / people, float(low), float(high)),
        {name: failed[name] for name in scenario.expect},
        dict(Counter(outcome.end for outcome in outcomes).most_common()),
        outcomes,
    )
