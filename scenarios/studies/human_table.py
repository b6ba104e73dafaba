"""The two-sided table: every human model with every automation, with bootstrap intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from joblib import Parallel, delayed
from scipy.stats import bootstrap

from cowalk.agents.registry import HUMANS
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from ..export.marked import markdown_table, write_marked
from ..files.schema import Component, Scenario, with_named
from ..running.runner import Progress, run
from .places import elsewhere
from .side_by_side import numbers_of

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
    "shorter, and so is the time over which their effort adds up: compare that by the metre."
)
"""What a reader of the table must know."""
CONFIDENCE = 0.95
MARK = "humans-table"


@dataclass(frozen=True)
class Interval:
    """A mean over seeds and its bootstrap interval; NaN where there is nothing to average.

    Attributes
    ----------
    mean, low, high : float
    runs : int
        Runs in which the metric applies: those in which the wishes differed, for concession.
    """

    mean: float
    low: float
    high: float
    runs: int


@dataclass(frozen=True)
class Cell:
    """One human with one automation.

    Attributes
    ----------
    human, automation : str
    metrics : dict
        `Interval` by the name of each of `METRICS`.
    ended_early : dict
        Number of runs that were cut short, by what cut them short (`EARLY`).
    """

    human: str
    automation: str
    metrics: dict[str, Interval]
    ended_early: dict[str, int]


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
    outcomes = Parallel(n_jobs=jobs, return_as="generator")(
        delayed(_measure)(scenario, *task) for task in tasks
    )
    values: dict[tuple[str, str], list[tuple[float, ...]]] = {pair: [] for pair in pairs}
    ends: dict[tuple[str, str], list[str]] = {pair: [] for pair in pairs}
    for done, ((human, automation, _), (found, end)) in enumerate(
        zip(tasks, outcomes, strict=True), start=1
    ):
        values[human, automation].append(found)
        ends[human, automation].append(end)
        if progress is not None:
            progress(done, len(tasks))
    return [
        Cell(
            *pair,
            dict(zip(METRICS, map(estimate, np.array(values[pair]).T), strict=True)),
            {end: ends[pair].count(end) for end in EARLY},
        )
        for pair in pairs
    ]


def _measure(
    scenario: Scenario, human: str, automation: str, seed: int
) -> tuple[tuple[float, ...], str]:
    """Return the `METRICS` of one run, and how it ended."""
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
    return tuple(values[name] for name in METRICS), result.summary["end"]


def estimate(values: Array) -> Interval:
    """Return the mean of what is not NaN, and its interval by the bias-corrected bootstrap.

    Parameters
    ----------
    values : ndarray, shape (n,)
    """
    known = values[np.isfinite(values)]
    if not known.size:
        return Interval(math.nan, math.nan, math.nan, 0)
    mean = float(known.mean())
    if known.size < 2 or np.ptp(known) < 1e-12:  # nothing to resample
        spread = 0.0 if known.size > 1 else math.nan
        return Interval(mean, mean - spread, mean + spread, int(known.size))
    interval = bootstrap(
        (known,), np.mean, confidence_level=CONFIDENCE, n_resamples=2000, rng=0
    ).confidence_interval
    return Interval(mean, float(interval.low), float(interval.high), int(known.size))


def header() -> tuple[str, ...]:
    """Return the column heads of the table."""
    heads = (f"{name}, {unit}" for name, unit in METRICS.items())
    return ("human", "automation", *heads, "ended early")


def row(cell: Cell) -> tuple[str, ...]:
    """Return a cell as text: means with their intervals, and how many runs ended early."""
    texts = []
    for found in cell.metrics.values():
        interval = f" [{found.low:.2f}, {found.high:.2f}]" if math.isfinite(found.low) else ""
        texts.append(f"{found.mean:.2f}{interval}" if found.runs else "-")
    cut = [f"{count} by {end}" for end, count in cell.ended_early.items() if count]
    early = ", ".join(cut) or "none"
    return (cell.human, cell.automation, *texts, early)


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
