"""Smoothers side by side: error and lag against the human's true stubbornness."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from joblib import Parallel, delayed

from cowalk.estimation.registry import SMOOTHERS
from cowalk.estimation.scores.error import bias, lag, rmse
from cowalk.sim.basics.errors import InputError

from ..files.schema import Scenario, with_named
from ..running.runner import run

PAPERS = "moving-average"


@dataclass(frozen=True)
class SmootherScore:
    """Scores of one smoother in the loop, mean over seeds; stubbornness in omega.

    Attributes
    ----------
    smoother : str
    rmse, bias : float
        Error of the smoothed stubbornness against the true one, 1.
    lag : float
        Delay behind the truth at the peak of the cross-correlation, s. It is negative where
        the force that is read comes before the stubbornness that it brings about.
    delay : float
        Delay behind the estimate that went into the smoother, s: the smoother's own.
    unsmoothed_rmse : float
        Error of the estimate that went into the smoother, 1.
    rmse_spread, lag_spread : float
        Standard deviation over the seeds; 0 for one seed.
    runs : int
        Number of seeds.
    """

    smoother: str
    rmse: float
    rmse_spread: float
    bias: float
    lag: float
    lag_spread: float
    delay: float
    unsmoothed_rmse: float
    runs: int


def compare_smoothers(
    scenario: Scenario,
    seeds: int = 5,
    progress: Callable[[int, int], None] | None = None,
    jobs: int = -1,
) -> list[SmootherScore]:
    """Run a scenario with every registered smoother in the loop, and score each.

    Parameters
    ----------
    scenario : Scenario
    seeds : int
        Runs a smoother, with the scenario's seed and the ones that follow it.
    progress : callable, optional
        Called with the runs done and their total.
    jobs : int
        Processes at once; -1 is one a core.

    Returns
    -------
    list of SmootherScore
        The paper's moving average first, then by name.

    Raises
    ------
    InputError
        If there is not at least one seed, or a run was aborted.
    """
    if seeds < 1:
        raise InputError(f"seeds = {seeds}: at least 1 seed is needed", ("seeds",))
    names = sorted(SMOOTHERS, key=lambda name: (name != PAPERS, name))
    tasks = [(name, scenario.seed + offset) for name in names for offset in range(seeds)]
    outcomes = Parallel(n_jobs=jobs, return_as="generator")(
        delayed(_scores)(scenario, name, seed) for name, seed in tasks
    )
    scores: dict[str, list[tuple[float, ...]]] = {name: [] for name in names}
    for done, ((name, _), values) in enumerate(zip(tasks, outcomes, strict=True), start=1):
        scores[name].append(values)
        if progress is not None:
            progress(done, len(tasks))
    return [_summary(name, np.array(scores[name])) for name in names]


def _scores(scenario: Scenario, smoother: str, seed: int) -> tuple[float, ...]:
    """Return (rmse, bias, lag, delay, unsmoothed rmse) of one run."""
    chosen = with_named(scenario, "smoother", smoother)
    result = run(chosen.model_copy(update={"seed": seed}))
    if result.error is not None:
        raise InputError(f"smoother {smoother!r}, seed {seed}: {result.error}")
    trace, period = result.trace, scenario.rates.period
    truth = trace["true_stubbornness_omega"]
    smoothed = trace["smoothed_stubbornness_omega"]
    estimate = trace["est_stubbornness_omega"]
    return (
        rmse(smoothed, truth),
        bias(smoothed, truth),
        lag(smoothed, truth, period),
        lag(smoothed, estimate, period),
        rmse(estimate, truth),
    )


def _summary(name: str, values: np.ndarray) -> SmootherScore:
    mean, spread = values.mean(axis=0), values.std(axis=0)
    return SmootherScore(
        smoother=name,
        rmse=float(mean[0]),
        rmse_spread=float(spread[0]),
        bias=float(mean[1]),
        lag=float(mean[2]),
        lag_spread=float(spread[2]),
        delay=float(mean[3]),
        unsmoothed_rmse=float(mean[4]),
        runs=len(values),
    )
