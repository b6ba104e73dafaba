"""All parts of a kind in one scenario: each walks with the same people, and is measured."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from cowalk.agents.registry import HUMANS
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from ..expect.verdict import judge
from ..files.building import parameter_names
from ..files.parts import kind_of_part
from ..files.schema import Scenario, part_of, with_named, with_part
from ..people.person import with_person
from ..people.population import Population
from ..result import RunResult
from ..running.parallel import each_of
from ..running.runner import Progress, run
from .places import Place, places

Measure = Callable[[RunResult], dict[str, float]]
_REQUIRED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


def measure_each(
    scenario: Scenario,
    kind: str,
    own: Sequence[str],
    measure: Measure,
    population: Population,
    people: int,
    progress: Progress | None = None,
    jobs: int = -1,
) -> dict[str, dict[str, Array]]:
    """Let everybody walk with every part of a kind, and measure each run.

    Body, gait, parameters, world and every noise stream are the same with each part. Where
    humans are compared, each model walks in everybody's body, with their strength and gain.

    Parameters
    ----------
    scenario : Scenario
        The part that it names keeps its parameters, the others have defaults.
    kind : str
        As in the table of parts.
    own : sequence of str
        Compared besides the registered ones, each ``module:Class``.
    measure : callable
        Numbers of a run by name; a function of a module, since it is sent to other processes.
    population : Population
    people : int
        Each walks three times, the obstacles elsewhere.
    progress : callable, optional
        Called with the runs done and their total.
    jobs : int
        Processes at once; -1 is one a core.

    Returns
    -------
    dict of str to dict
        By part, each number by its name, shape (runs,), and ``passed``, 1 for a run that meets the
        scenario's expectations. The kind's default, or else the scenario's part, comes first;
        one's own next, then by name.

    Raises
    ------
    InputError
        If there are fewer than two people, a name is unknown, or a run was aborted.
    """
    names = entries_of(scenario, kind, own)
    walked = places(scenario, population, people)
    tasks = [(name, place) for name in names for place in walked]
    whole = [(scenario, kind, *task, measure) for task in tasks]
    found: dict[str, list[dict[str, float]]] = {name: [] for name in names}
    for (name, _), values in zip(tasks, each_of(_measured, whole, progress, jobs), strict=True):
        found[name].append(values)
    return {
        name: {key: np.array([values[key] for values in runs]) for key in runs[0]}
        for name, runs in found.items()
    }


def numbers_of(result: RunResult) -> dict[str, float]:
    """Return the metrics of a run by name; NaN where one does not apply."""
    values = {name: found["value"] for name, found in result.summary["metrics"].items()}
    return {name: math.nan if value is None else value for name, value in values.items()}


def meets(result: RunResult, expect: Mapping[str, str]) -> bool:
    """Return whether a run meets expectations.

    One about what only another part adds to the trace is not met.
    """
    try:
        verdicts = judge(expect, result.trace.columns(), result.scenario.rates.period)
    except InputError:
        return False
    return all(verdict.passed for verdict in verdicts)


def entries_of(scenario: Scenario, kind: str, own: Sequence[str]) -> list[str]:
    """Return what is compared: what needs no parameters, or has them from the scenario.

    The kind's default, or else the scenario's part, comes first; one's own next, then by name.

    Raises
    ------
    InputError
        If a name is unknown.
    """
    part, present = kind_of_part(kind), part_of(scenario, kind).name
    registry = part.registry()
    for name in own:
        registry.get(name)
    ready = [name for name in registry.names() if name == present or not _needs(registry.get(name))]
    return list(dict.fromkeys([part.default or present, *own, present, *ready]))


def _needs(constructor: Callable[..., object]) -> bool:
    parameters = inspect.signature(constructor).parameters.values()
    return any(item.default is item.empty and item.kind in _REQUIRED for item in parameters)


def _measured(
    scenario: Scenario, kind: str, name: str, place: Place, measure: Measure
) -> dict[str, float]:
    chosen = with_person(place.scenario, place.person)
    if kind == "human":
        human = part_of(with_named(scenario, kind, name), kind)
        own = parameter_names(HUMANS.get(name))
        theirs = chosen.human.parameters
        traits = {each: theirs[each] for each in ("force_max", "gain") if each in theirs}
        parameters = {key: value for key, value in traits.items() if key in own}
        update = {"name": name, "parameters": human.parameters | parameters}
        chosen = with_part(chosen, kind, chosen.human.model_copy(update=update))
    else:
        chosen = with_named(chosen, kind, name)
    result = run(chosen)
    if result.error is not None:
        raise InputError(f"{kind} {name!r}, {place.name}: {result.error}")
    return measure(result) | {"passed": float(meets(result, scenario.expect))}
