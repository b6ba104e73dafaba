"""The paper's reported numbers beside ours, from the shipped scenario ``paper-open-loop``.

Schneider et al., arXiv 2407.17275, section IV. The paper prints l = 5 and v = 0.8 m/s; all
other constants are inferred (`cowalk.scenarios.studies.calibration`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from cowalk.sim.basics.motion import Array

from ..result import RunResult

SCENARIO = "paper-open-loop"
SETTLED_OVER = 5
"""Negotiations before a change of force over which stubbornness counts as settled: l."""
AGREED = 0.05
"""Share of the turn-rate bound within which two turn rates count as equal."""


@dataclass(frozen=True)
class Reported:
    """A number that the paper reports, and how far off ours may be."""

    name: str
    value: float
    tolerance: float
    unit: str


REPORTED = {
    "first": Reported("stubbornness at the first step with 3 N", 0.40, 0.03, "1"),
    "next": Reported("stubbornness at the next step", 0.33, 0.03, "1"),
    "settled_4": Reported("stubbornness settled at 4 N", 0.44, 0.03, "1"),
    "settled_5": Reported("stubbornness settled at 5 N", 0.50, 0.03, "1"),
    "start": Reported("target utility at the start", 1.0, 0.03, "1"),
    "lowest": Reported("lowest target utility, 27 to 33 s", 0.50, 0.03, "1"),
    "steep_until": Reported("target utility falls steeply until", 15.5, 0.7, "s"),
    "agrees": Reported("turn rate equals the automation's wish again", 34.4, 0.7, "s"),
    "largest_y": Reported("largest lateral offset", 0.52, 0.04, "m"),
}


@dataclass(frozen=True)
class Row:
    """One reported number beside ours."""

    name: str
    reported: float
    ours: float
    tolerance: float
    unit: str
    passed: bool


def measure(
    time: Array,
    stubbornness: Array,
    target_utility: Array,
    omega: Array,
    wish: Array,
    y: Array,
    omega_bound: Array | float,
) -> dict[str, Array]:
    """Return what the paper reports, measured on a run of its scenario.

    Settled is the mean over the last five negotiations before the force changes; the steep
    fall ends with the last of the first drops that are at least half the largest; turn rates
    are equal again from the first negotiation on after which they stay within 5 % of the bound
    until the run ends, infinity if they end apart: curves that cross and part are not equal.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Times of the negotiations, s.
    stubbornness, target_utility, omega, wish : ndarray, shape (n, ...)
        Estimated stubbornness, target utility, agreed and own wished turn rate (rad/s).
    y : ndarray, shape (m, ...)
        Lateral offset, m, on any samples.
    omega_bound : float or ndarray, shape (...)
        Upper bound of the turn rate, rad/s.

    Returns
    -------
    dict of ndarray, shape (...)
        By the keys of `REPORTED`.
    """

    def at(moment: float) -> int:
        return int(np.searchsorted(time, moment - 1e-6))

    def settled(before: float) -> Array:
        return np.asarray(stubbornness[at(before) - SETTLED_OVER : at(before)].mean(axis=0))

    push, release = at(12.0), at(33.0)
    drops = -np.diff(target_utility[push - 1 : at(19.0)], axis=0)
    shallow = drops < 0.5 * drops.max(axis=0)
    apart = np.abs(omega - wish)[release:] > AGREED * omega_bound
    # Negotiations since the last that was apart, counted from the end of the run.
    together = np.where(apart.any(axis=0), np.argmax(apart[::-1], axis=0), len(apart))
    since = np.append(time[release:], np.inf)
    return {
        "first": stubbornness[push],
        "next": stubbornness[push + 1],
        "settled_4": settled(23.0),
        "settled_5": settled(33.0),
        "start": target_utility[0],
        "lowest": target_utility[at(27.0) : release].min(axis=0),
        "steep_until": time[push - 1 + np.argmax(shallow, axis=0)],
        "agrees": since[len(apart) - together],
        "largest_y": y.max(axis=0),
    }


def rows(measured: Mapping[str, Array]) -> list[Row]:
    """Return the comparison of measured values with the reported ones."""
    return [
        Row(
            reported.name,
            reported.value,
            float(measured[key]),
            reported.tolerance,
            reported.unit,
            bool(abs(measured[key] - reported.value) <= reported.tolerance),
        )
        for key, reported in REPORTED.items()
    ]


def run_paper(overrides: Sequence[str] = ()) -> RunResult:
    """Run the paper's scenario, with ``KEY=VALUE`` overrides."""
    from ..files.loading import load
    from ..running.runner import run

    return run(load(SCENARIO, overrides))


def reproduce(result: RunResult | None = None) -> list[Row]:
    """Return the paper's reported numbers beside ours.

    Parameters
    ----------
    result : RunResult, optional
        A run of the paper's scenario; run now if not given.
    """
    result = run_paper() if result is None else result
    trace, period = result.trace, result.scenario.rates.period
    first = np.concatenate(([True], np.diff(trace["negotiation"]) > 0))
    return rows(
        measure(
            time=trace["t"][first] - period,
            stubbornness=trace["est_stubbornness_omega"][first],
            target_utility=trace["target_utility"][first],
            omega=trace["omega_cmd"][first],
            wish=trace["wish_omega"][first],
            y=trace["y"],
            omega_bound=result.scenario.bounds.upper[1],
        )
    )


def constants() -> dict[str, Any]:
    """Return the constants of the scenario that the paper does not print, with units."""
    from ..files.loading import load

    scenario = load(SCENARIO)
    negotiation = scenario.automation.negotiation
    return {
        "omega_ub = -omega_lb, rad/s": scenario.bounds.upper[1],
        "horizon tau, s": negotiation.horizon,
        "w3/w1, m^2 s^2/rad^2": negotiation.turn_weight / negotiation.distance_weight,
        "negotiation period, s": negotiation.period,
        "F_y,max, N": negotiation.force_max[1],
        "f_omega": negotiation.sensitivity[1],
        "I_min": scenario.automation.parameters["interaction_min"],
        "I_max": scenario.automation.parameters["interaction_max"],
    }


def draw(folder: str | Path, overrides: Sequence[str] = ()) -> list[Path]:
    """Draw the paper's two figures into a folder and return the files.

    Parameters
    ----------
    folder : str or Path
    overrides : sequence of str
        As in `run_paper`.

    Raises
    ------
    InputError
        If the folder cannot be written.
    """
    from ..export.folder import writable_folder
    from ..figures.paper import draw_paper_panels, draw_utility_loss

    target = writable_folder(folder)
    files = [target / "utility_loss.png", target / "panels.png"]
    draw_utility_loss(files[0])
    marks = [
        ("stubbornness", 12.6, 0.40, "0.40"),
        ("stubbornness", 13.3, 0.33, "0.33"),
        ("stubbornness", 22.4, 0.44, "0.44"),
        ("stubbornness", 32.2, 0.50, "0.50"),
        ("target_utility", 0.0, 1.0, "1"),
        ("target_utility", 30.0, 0.50, "0.50"),
        ("target_utility", 15.5, float("nan"), "15.5 s"),
        ("omega", 34.4, float("nan"), "34.4 s"),
        ("y", 29.0, 0.52, "0.52 m"),
    ]
    draw_paper_panels(run_paper(overrides), files[1], marks)
    return files
