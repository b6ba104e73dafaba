"""A scenario tried: one control step, and every formula judged on a made-up trace."""

from __future__ import annotations

import math

import numpy as np

from cowalk.sim.basics.errors import InputError, told

from ..files.schema import Scenario
from ..trace.columns import UNITS
from ..yaml_text.document import Fault
from .runner import run

MOST_ROWS = 200
"""Of the made-up trace: beyond them a formula is judged as they all are."""
_ODD = (math.nan, math.inf, -math.inf, 0.0)


def trial(scenario: Scenario) -> list[Fault]:
    """Return what keeps a scenario from taking its first step, or its formulas from being judged.

    Parameters
    ----------
    scenario : Scenario
        One that is loaded, so that nothing is wrong with it as it stands.
    """
    period = max(scenario.rates.period, 0.01)
    short = scenario.model_copy(update={"duration": period, "expect": {}})
    try:
        result = run(short)
    except InputError as error:
        return [Fault(error.at, f"it cannot begin: {error}")]
    if result.error is not None:
        return [Fault((), f"it takes no step: {result.error}")]
    return _unjudged(scenario, tuple(dict.fromkeys((*UNITS, *result.trace.columns()))))


def _unjudged(scenario: Scenario, names: tuple[str, ...]) -> list[Fault]:
    from ..expect.verdict import judge

    period = scenario.rates.period
    rows = min(max(round(scenario.duration / period), 1), MOST_ROWS)
    rng = np.random.default_rng(0)
    columns = {name: rng.normal(size=rows) for name in names}
    for column in columns.values():  # what a trace may hold, too
        column[rng.integers(rows)] = rng.choice(_ODD)
    columns["t"] = period * np.arange(1.0, rows + 1.0)
    found = []
    for name, formula in scenario.expect.items():
        try:
            judge({name: formula}, columns, period)
        except Exception as error:  # rtamt fails in its own ways
            what = f"expect.{name} = {formula!r}: it cannot be judged ({told(error)})"
            found.append(Fault(("expect", name), what))
    return found
