"""What a run amounts to, in numbers: safety, negotiation, effort and estimation."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from cowalk.estimation.scores.error import bias, rmse
from cowalk.estimation.scores.lag import lag
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.path import Path

AGREEMENT = 0.05
"""Difference between human's wish and executed turn rate that counts as agreement, rad/s."""
HELD = 2.0
"""Time for which agreement must last to count, s."""


def metrics(
    columns: Mapping[str, Array], period: float, path: Path
) -> dict[str, dict[str, float | str]]:
    """Return the metrics of a trace.

    Parameters
    ----------
    columns : mapping of str to ndarray, shape (rows,)
        Trace columns (`cowalk.scenarios.trace.columns.UNITS`), at least one row.
    period : float
        Control period, s.
    path : Path
        What lateral offset refers to.

    Returns
    -------
    dict
        ``{"value": ..., "unit": ...}`` by name; NaN where a metric does not apply.
    """
    force = np.hypot(columns["fx"], columns["fy"])
    # Of the measured push alone: the column `work` has what turning and slipping add.
    power = columns["fx"] * columns["v"]
    truth, estimate = columns["true_stubbornness_omega"], columns["est_stubbornness_omega"]
    smoothed = columns["smoothed_stubbornness_omega"]
    pose = np.stack((columns["x"], columns["y"], columns["theta"]), axis=-1)
    offset = path.relative_pose(pose)[:, 1]
    values: dict[str, tuple[float, str]] = {
        "smallest clearance": (float(np.min(columns["clearance"])), "m"),
        "largest lateral offset": (float(offset[np.argmax(np.abs(offset))]), "m"),
        "distance walked": (float(np.sum(np.abs(columns["v"])) * period), "m"),
        "mean force": (float(np.mean(force)), "N"),
        "peak force": (float(np.max(force)), "N"),
        "effort": (float(np.sum(force) * period), "N s"),
        "interaction work": (float(np.sum(power) * period), "J"),
        "lowest target utility": (_least(columns["target_utility"]), "1"),
        "time to agreement": (_time_to_agreement(columns, period), "s"),
        "stubbornness RMSE": (float(rmse(estimate, truth).value), "1"),
        "stubbornness bias": (float(bias(estimate, truth).value), "1"),
        "smoothed stubbornness RMSE": (float(rmse(smoothed, truth).value), "1"),
        "smoothed stubbornness lag": (lag(smoothed, truth, period), "s"),
    }
    return {name: {"value": value, "unit": unit} for name, (value, unit) in values.items()}


def _least(column: Array) -> float:
    known = column[np.isfinite(column)]
    return float(known.min()) if known.size else float("nan")


def _time_to_agreement(columns: Mapping[str, Array], period: float) -> float:
    """Return the time from the first disagreement to the first agreement that is held, s."""
    if np.isnan(columns["true_omega"]).all():
        return float("nan")  # of a wish that nobody knows nothing can be agreed
    apart = np.abs(columns["true_omega"] - columns["omega"]) > AGREEMENT
    if not apart.any():
        return 0.0
    start = int(np.argmax(apart))
    window = max(1, round(HELD / period))
    changes = np.concatenate(([0], np.cumsum(apart[start:])))
    within = changes[window:] - changes[:-window]
    if not within.size or within.min() > 0:
        return float("nan")
    return float(np.argmax(within == 0) * period)
