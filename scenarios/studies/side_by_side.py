"""All parts of a kind in one scenario: each is run with the same seeds, and measured."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Sequence

import numpy as np
from joblib import Parallel, delayed

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from ..files.parts import Part, kind_of_part
from ..files.schema import Scenario, part_of, with_named
from ..result import RunResult
from ..running.runner import run

Measure = Callable[[RunResult], dict[str, float]]
Progress = Callable[[int, int], None]
_REQUIRED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


def measure_each(
    scenario: Scenario,
    kind: str,
    own: Sequence[str],
    measure: Measure,
    seeds: int,
    progress: Progress | None = None,
    jobs: int = -1,
) -> dict[str, dict[str, Array]]:
    """Run a scenario with every part of a kind, and measure each run.

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
    seeds : int
        Runs a part, with the scenario's seed and the ones that follow it.
    progress : callable, optional
        Called with the runs done and their total.
    jobs : int
        Processes at once; -1 is one a core.

    Returns
    -------
    dict of str to dict
        By part, each number by its name, shape (seeds,). The kind's default, or else the
        scenario's part, comes first; one's own next, then by name.

    Raises
    ------
    InputError
        If there is not at least one seed, a name is unknown, or a run was aborted.
    """
    if seeds < 1:
        raise InputError(f"seeds = {seeds}: at least 1 seed is needed", ("seeds",))
    part = kind_of_part(kind)
    for name in own:
        part.registry().get(name)
    names = _names(part, part_of(scenario, kind).name, own)
    tasks = [(name, scenario.seed + offset) for name in names for offset in range(seeds)]
    outcomes = Parallel(n_jobs=jobs, return_as="generator")(
        delayed(_measured)(scenario, kind, *task, measure) for task in tasks
    )
    found: dict[str, list[dict[str, float]]] = {name: [] for name in names}
    for done, ((name, _), values) in enumerate(zip(tasks, outcomes, strict=True), start=1):
        found[name].append(values)
        if progress is not None:
            progress(done, len(tasks))
    return {
        name: {key: np.array([values[key] for values in runs]) for key in runs[0]}
        for name, runs in found.items()
    }


def numbers_of(result: RunResult) -> dict[str, float]:
    """Return the metrics of a run by name; NaN where one does not apply."""
    values = {name: found["value"] for name, found in result.summary["metrics"].items()}
    return {name: math.nan if value is None else value for name, value in values.items()}


def _names(part: Part, present: str, own: Sequence[str]) -> list[str]:
    """Return what is compared: what needs no parameters, or has them from the scenario."""
    registry = part.registry()
    ready = [name for name in registry.names() if name == present or not _needs(registry.get(name))]
    return list(dict.fromkeys([part.default or present, *own, present, *ready]))


def _needs(constructor: Callable[..., object]) -> bool:
    parameters = inspect.signature(constructor).parameters.values()
    return any(item.default is item.empty and item.kind in _REQUIRED for item in parameters)


def _measured(
    scenario: Scenario, kind: str, name: str, seed: int, measure: Measure
) -> dict[str, float]:
    chosen = with_named(scenario, kind, name)
    result = run(chosen.model_copy(update={"seed": seed}))
    if result.error is not None:
        raise InputError(f"{kind} {name!r}, seed {seed}: {result.error}")
    return measure(result)
