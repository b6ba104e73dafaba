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
    mean_force : float
        Measured, N.
    effort : float
        Integral of the force over time, N s.
    smallest_clearance : float
        m.
    lowest_target_utility : float
        What the automation demands at least, 1; NaN where it has no such.
    time_to_agreement : float
        Over the runs that reached it, s.
    agreed, reached_goal, runs : int
        Number of runs that reached agreement, that ended at the goal, and of all.
    """

    name: str
    mean_force: float
    effort: float
    smallest_clearance: float
    lowest_target_utility: float
    time_to_agreement: float
    agreed: int
    reached_goal: int
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
    agreement = numbers["time to agreement"]
    known = agreement[np.isfinite(agreement)]
    return AgentScore(
        name=name,
        mean_force=float(numbers["mean force"].mean()),
        effort=float(numbers["effort"].mean()),
        smallest_clearance=float(numbers["smallest clearance"].mean()),
        lowest_target_utility=float(numbers["lowest target utility"].mean()),
        time_to_agreement=float(known.mean()) if known.size else math.nan,
        agreed=known.size,
        reached_goal=int(numbers["goal"].sum()),
        runs=len(agreement),
    )


def _fared(result: RunResult) -> dict[str, float]:
    """Return the metrics of one run, and whether it ended at the goal."""
    return numbers_of(result) | {"goal": float(result.summary["end"] == "goal")}
