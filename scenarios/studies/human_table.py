"""The two-sided table: every human model with every automation, with bootstrap intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from cowalk.agents.registry import HUMANS
from cowalk.estimation.scores.people import Interval, People, bootstrap
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from ..export.marked import markdown_table, write_marked
from ..files.schema import Component, Scenario, with_named
from ..running.parallel import each_of
from ..running.runner import Progress, run
from .places import elsewhere
from .side_by_side import meets, numbers_of

AUTOMATIONS_COMPARED = ("never-yields", "always-yields", "stubbornness")
"""The two ends of the scale, and the paper's automation."""
BODY = ("reaction-delay", "signal-dependent-noise")
"""Imperfections of every model where the scenario names none, at their defaults.

Gait ripple is not among them: at +- 3 N it is as large as what the models differ by.
"""
METRICS = {
    "intended effort": "N s",
    "intended effort a metre": "N s/m",
    "time apart, omega": "s",
    "executed concession, omega": "1",
}
"""What is compared, and its unit; effort also by the metre of progress, since runs differ in
length."""
EARLY = ("collision", "grip lost", "lost footing")
"""Ends of a run that cut it short."""
NOTE = (
    "Concession: over the runs in which the two wanted something else. Runs that ended early are "
    "shorter, and so is the time over which their effort adds up: compare that by the metre. "
    "Passes: runs that met the scenario's expectations, though the obstacles were moved."
)
"""What a reader of the table must know."""
MARK = "humans-table"


@dataclass(frozen=True)
class Cell:
    """One human with one automation.

    Attributes
    ----------
    human, automation : str
    metrics : dict
        Mean over seeds with its `Interval`, by the name of each of `METRICS`; NaN where there is
        nothing to average.
    known : dict
        Number of runs in which each of these applies: those in which the wishes differed, for
        concession.
    ended_early : dict
        Number of runs that were cut short, by what cut them short (`EARLY`).
    passes, runs : int
        Number of runs that met the scenario's expectations, and of all.
    """

    human: str
    automation: str
    metrics: dict[str, Interval]
    known: dict[str, int]
    ended_early: dict[str, int]
    passes: int
    runs: int


def compare_humans(
    scenario: Scenario,
    seeds: int = 30,
    progress: Progress | None = None,
    jobs: int = -1,
    humans: Sequence[str] | None = None,
    automations: Sequence[str] = AUTOMATIONS_COMPARED,
) -> list[Cell]:
    """Run every human model with every automation.

    All models keep the scenario's intention and imperfections (`BODY` where it has none). The
    scenario's own human and automation keep their parameters, the others have defaults. From
    seed to seed the obstacles lie elsewhere, the same for every pair.

    Parameters
    ----------
    scenario : Scenario
    seeds : int
        Runs a pair, with the scenario's seed and the ones that follow it.
    progress : callable, optional
        Called with the runs done and their total.
    jobs : int
        Processes at once; -1 is one a core.
    humans : sequence of str, optional
        All registered ones whose force answers the base's motion, unless given.
    automations : sequence of str

    Returns
    -------
    list of Cell

    Raises
    ------
    InputError
        If there are not at least two seeds, a human cannot be built from its defaults, or a
        run was aborted.
    """
    if seeds < 2:
        raise InputError(
            f"seeds = {seeds}: at least 2 seeds are needed for an interval", ("seeds",)
        )
    names = humans or [n for n in HUMANS if getattr(HUMANS.get(n), "closed_loop", True)]
    pairs = [(human, automation) for human in names for automation in automations]
    tasks = [(*pair, scenario.seed + offset) for pair in pairs for offset in range(seeds)]
    outcomes = each_of(_measure, [(scenario, *task) for task in tasks], progress, jobs)
    measured: dict[tuple[str, str], list[_Measured]] = {pair: [] for pair in pairs}
    for (human, automation, _), found in zip(tasks, outcomes, strict=True):
        measured[human, automation].append(found)
    return [_cell(*pair, runs) for pair, runs in measured.items()]


class _Measured(NamedTuple):
    """The `METRICS` of one run, how it ended, and whether it met the expectations."""

    values: tuple[float, ...]
    end: str
    passed: bool


def _cell(human: str, automation: str, runs: Sequence[_Measured]) -> Cell:
    values = dict(zip(METRICS, np.array([run.values for run in runs]).T, strict=True))
    ends = [run.end for run in runs]
    return Cell(
        human,
        automation,
        {name: estimate(found) for name, found in values.items()},
        {name: int(np.isfinite(found).sum()) for name, found in values.items()},
        {end: ends.count(end) for end in EARLY},
        sum(run.passed for run in runs),
        len(runs),
    )


def _measure(scenario: Scenario, human: str, automation: str, seed: int) -> _Measured:
    scenario = with_named(with_named(scenario, "human", human), "automation", automation)
    body = scenario.human.imperfections or tuple(Component(name=name) for name in BODY)
    result = run(
        scenario.model_copy(
            update={
                "human": scenario.human.model_copy(update={"imperfections": body}),
                "seed": seed,
                "world": elsewhere(scenario.world, seed),
                "expect": {},
            }
        )
    )
    if result.error is not None:
        raise InputError(f"human {human!r}, automation {automation!r}, seed {seed}: {result.error}")
    values = numbers_of(result)
    passed = meets(result, scenario.expect)
    return _Measured(tuple(values[name] for name in METRICS), result.summary["end"], passed)


def estimate(values: Array) -> Interval:
    """Return the mean of what is not NaN, and its bootstrap interval; NaN where there is none.

    Parameters
    ----------
    values : ndarray, shape (n,)
    """
    known = values[np.isfinite(values)]
    if known.size < 2 or np.ptp(known) < 1e-12:  # nothing to resample
        mean = float(known.mean()) if known.size else math.nan
        spread = 0.0 if known.size > 1 else math.nan
        return Interval(mean, mean - spread, mean + spread)
    runs = People(known[:, np.newaxis], np.full(known.size, "runs"))
    return bootstrap(runs, lambda means: means[..., 0])


def header() -> tuple[str, ...]:
    """Return the column heads of the table."""
    heads = (f"{name}, {unit}" for name, unit in METRICS.items())
    return ("human", "automation", *heads, "passes", "ended early")


def row(cell: Cell) -> tuple[str, ...]:
    """Return a cell as text: means with their intervals, runs that passed, that ended early."""
    texts = []
    for value, low, high in cell.metrics.values():
        interval = f" [{low:.2f}, {high:.2f}]" if math.isfinite(low) else ""
        texts.append("-" if math.isnan(value) else f"{value:.2f}{interval}")
    cut = [f"{count} by {end}" for end, count in cell.ended_early.items() if count]
    early = ", ".join(cut) or "none"
    passes = f"{cell.passes} of {cell.runs}"
    return (cell.human, cell.automation, *texts, passes, early)


def write_table(file: Path, cells: Sequence[Cell], scenario: str, plant: str, seeds: int) -> None:
    """Put the table between its marks in a Markdown document.

    Parameters
    ----------
    file : Path
        Holds the lines ``<!-- humans-table -->`` and ``<!-- /humans-table -->``.
    cells, scenario, plant, seeds
        What is shown, and what made it.

    Raises
    ------
    InputError
        See `marked_document`.
    """
    table = markdown_table(header(), map(row, cells))
    caption = (
        f"Scenario `{scenario}` on the {plant} plant, {seeds} seeds; mean and 95 % bootstrap "
        f"interval. {NOTE}"
    )
    write_marked(file, MARK, f"{caption}\n\n{table}")
