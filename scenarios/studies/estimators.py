"""Estimators side by side: error and lag against the human's true stubbornness."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cowalk.estimation.scores.error import bias, rmse
from cowalk.estimation.scores.lag import lag
from cowalk.sim.basics.motion import Array

from ..files.schema import Scenario
from ..result import RunResult
from .side_by_side import Progress, measure_each


@dataclass(frozen=True)
class SmootherScore:
    """Scores of one smoother in the loop, mean over seeds; stubbornness in omega.

    Attributes
    ----------
    name : str
    rmse, bias : float
        Error of the smoothed stubbornness against the true one, 1.
    lag : float
        Delay behind the truth at the peak of the cross-correlation, s. It is negative where
        the force that is read comes before the stubbornness that it brings about, and NaN where
        no delay can be read in a run (`cowalk.estimation.lag`).
    delay : float
        Delay behind the estimate that went into the smoother, s: the smoother's own.
    unsmoothed_rmse : float
        Error of the estimate that went into the smoother, 1.
    rmse_spread, lag_spread : float
        Standard deviation over the seeds; 0 for one seed.
    runs : int
        Number of seeds.
    """

    name: str
    rmse: float
    rmse_spread: float
    bias: float
    lag: float
    lag_spread: float
    delay: float
    unsmoothed_rmse: float
    runs: int


@dataclass(frozen=True)
class EstimateScore:
    """Scores of the estimates with one observer or front end, mean over seeds; in omega.

    Attributes
    ----------
    name : str
    rmse, bias : float
        Error of the estimated stubbornness against the true one, 1.
    lag : float
        Delay behind the truth at the peak of the cross-correlation, s; NaN where no delay can
        be read in a run.
    wish_rmse : float
        Error of the estimated wish against the true one, rad/s.
    rmse_spread, lag_spread : float
        Standard deviation over the seeds; 0 for one seed.
    runs : int
        Number of seeds.
    """

    name: str
    rmse: float
    rmse_spread: float
    bias: float
    lag: float
    lag_spread: float
    wish_rmse: float
    runs: int


def compare_smoothers(
    scenario: Scenario,
    kind: str = "smoother",
    own: Sequence[str] = (),
    seeds: int = 5,
    progress: Progress | None = None,
    jobs: int = -1,
) -> list[SmootherScore]:
    """Run a scenario with every smoother in the loop, and score each (see `measure_each`)."""
    found = measure_each(scenario, kind, own, _smoothed, seeds, progress, jobs)
    return [SmootherScore(name, runs=seeds, **_means(found[name])) for name in found]


def compare_estimators(
    scenario: Scenario,
    kind: str = "observer",
    own: Sequence[str] = (),
    seeds: int = 5,
    progress: Progress | None = None,
    jobs: int = -1,
) -> list[EstimateScore]:
    """Run a scenario with every observer, or front end, in the loop (see `measure_each`)."""
    found = measure_each(scenario, kind, own, _estimated, seeds, progress, jobs)
    return [EstimateScore(name, runs=seeds, **_means(found[name])) for name in found]


def _means(numbers: dict[str, Array]) -> dict[str, float]:
    """Return the mean of each number over the seeds, and of two the spread."""
    means = {name: float(values.mean()) for name, values in numbers.items()}
    return means | {f"{name}_spread": float(numbers[name].std()) for name in ("rmse", "lag")}


def _smoothed(result: RunResult) -> dict[str, float]:
    trace, period = result.trace, result.scenario.rates.period
    smoothed, estimate = trace["smoothed_stubbornness_omega"], trace["est_stubbornness_omega"]
    return _scores(result, smoothed) | {
        "delay": lag(smoothed, estimate, period),
        "unsmoothed_rmse": float(rmse(estimate, trace["true_stubbornness_omega"]).value),
    }


def _estimated(result: RunResult) -> dict[str, float]:
    trace = result.trace
    wish = float(rmse(trace["est_omega"], trace["true_omega"]).value)
    return _scores(result, trace["est_stubbornness_omega"]) | {"wish_rmse": wish}


def _scores(result: RunResult, estimate: Array) -> dict[str, float]:
    """Return how well a column of a run follows the true stubbornness."""
    truth = result.trace["true_stubbornness_omega"]
    return {
        "rmse": float(rmse(estimate, truth).value),
        "bias": float(bias(estimate, truth).value),
        "lag": lag(estimate, truth, result.scenario.rates.period),
    }
