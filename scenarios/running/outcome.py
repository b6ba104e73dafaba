"""What is said of a run that has ended: scored, judged, and nothing lost if that fails."""

from __future__ import annotations

import math
import platform
from collections.abc import Callable
from dataclasses import asdict
from functools import cache
from importlib.metadata import version
from traceback import format_exception
from typing import Any, TypeVar

from cowalk.sim.basics.errors import told

from ..expect.verdict import Verdict, judge
from ..export.json_ready import json_ready
from ..export.run_folder import picture
from ..files.assembling import named_parts
from ..files.schema import Scenario
from ..result import RunResult
from ..trace.trace import FORMAT, Trace

_VERSIONED = ("numpy", "scipy", "pybullet", "pettingzoo", "filterpy")

T = TypeVar("T")


class Attempt:
    """Does one thing after the other about a run, whether or not those before have failed.

    Parameters
    ----------
    fault : str or None
        The traceback of what has failed before.

    Attributes
    ----------
    fault : str or None
        That of the first failure.
    error : str or None
        Which, of those here, in a line.
    """

    def __init__(self, fault: str | None = None) -> None:
        self.fault = fault
        self.error: str | None = None

    def __call__(self, make: Callable[[], T], otherwise: T) -> T:
        """Return what is made, or what there is otherwise."""
        try:
            return make()
        except Exception as failure:
            self.fault = self.fault or "".join(format_exception(failure))
            self.error = self.error or f"scoring the run failed: {told(failure)}"
            return otherwise


def outcome(
    scenario: Scenario,
    trace: Trace,
    end: str,
    error: str | None,
    wall_time: float,
    measured: dict[str, Any],
    attempt: Attempt,
) -> RunResult:
    """Score and judge what was recorded.

    Parameters
    ----------
    scenario : Scenario
    trace : Trace
    end : str
        How it ended.
    error : str or None
        Why, if before its time.
    wall_time : float
        How long it took, s; NaN where nobody knows.
    measured : dict
        Its metrics, `cowalk.scenarios.running.measured.measured`.
    attempt : Attempt
        Notes what fails.
    """
    period = scenario.rates.period
    columns = trace.columns()
    rows = len(trace)
    verdicts: list[Verdict] = []
    if rows:
        verdicts = attempt(lambda: judge(scenario.expect, columns, period), verdicts)
    if error is None and attempt.error is not None:
        end, error = "aborted", f"{scenario.name}: {attempt.error}"
    simulated = rows * period
    lost = columns["t"][columns["footing_held"] == 0.0]
    summary: dict[str, Any] = {
        "format": FORMAT,
        "scenario": scenario.name,
        **named_parts(scenario),
        "seed": scenario.seed,
        "end": end,
        "error": error,
        "footing_lost_s": float(lost[0]) if len(lost) else None,
        "simulated_time_s": simulated,
        "wall_time_s": wall_time,
        "real_time_factor": simulated / wall_time if wall_time != 0.0 else math.inf,
        "metrics": measured,
        "expectations": [asdict(verdict) for verdict in verdicts],
        "versions": {"python": platform.python_version(), **versions()},
    }
    return RunResult(scenario, trace, json_ready(summary), verdicts, error, picture=picture)


@cache
def versions() -> dict[str, str]:
    """Return the versions of what a result depends on: read from files, so only once."""
    return {name: version(name) for name in ("cowalk", *_VERSIONED)}
