"""Humans, or automations, side by side: what walking together costs and where it leads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.motion import Array

from ..files.schema import Scenario
from ..people.population import Population
from ..result import RunResult
from ..running.runner import Progress
from .side_by_side import measure_each, numbers_of


@dataclass(frozen=True)
class AgentScore:
    """How one human, or automation, fares in a scenario, mean over walks of people.

    Attributes
    ----------
    name : str
    effort : float
        Integral of the intended force over time, N s.
    effort_a_metre : float
        The same by the metre of progress, N s/m: infinite where there was none in some run.
    clearance : float
        The smallest, m.
    time_apart : float
        Time for which human and base disagreed in omega, s.
    concession : float
        Executed: share of the disagreement in omega that the base gave way by; NaN where there
        was none.
    resolved_in_time : float
        Share of disagreements in omega that the base ended in time; NaN where there was none.
    reached_goal, passes, runs : int
        Number of runs that ended at the goal, that met the expectations, and of all.
    """

    name: str
    effort: float
    effort_a_metre: float
    clearance: float
    time_apart: float
    concession: float
    resolved_in_time: float
    reached_goal: int
    passes: int
    runs: int


def compare_agents(
    scenario: Scenario,
    kind: str,
    own: Sequence[str],
    population: Population,
    people: int = 6,
    progress: Progress | None = None,
    jobs: int = -1,
) -> list[AgentScore]:
    """Let people walk with every automation, or as every human model (see `measure_each`)."""
    found = measure_each(scenario, kind, own, _fared, population, people, progress, jobs)
    return [_score(name, values) for name, values in found.items()]


def _score(name: str, numbers: dict[str, Array]) -> AgentScore:
    a_metre = numbers["intended effort a metre"]
    return AgentScore(
        name=name,
        effort=float(numbers["intended effort"].mean()),
        effort_a_metre=float(a_metre.mean()) if np.isfinite(a_metre).all() else math.inf,
        clearance=float(numbers["smallest clearance"].mean()),
        time_apart=_known_mean(numbers["time apart, omega"]),
        concession=_known_mean(numbers["executed concession, omega"]),
        resolved_in_time=_known_mean(numbers["resolved in time, omega"]),
        reached_goal=int(numbers["goal"].sum()),
        passes=int(numbers["passed"].sum()),
        runs=len(a_metre),
    )


def _known_mean(values: Array) -> float:
    known = values[np.isfinite(values)]
    return float(known.mean()) if known.size else math.nan


def _fared(result: RunResult) -> dict[str, float]:
    """Return the metrics of one run, and whether it ended at the goal."""
    return numbers_of(result) | {"goal": float(result.summary["end"] == "goal")}
