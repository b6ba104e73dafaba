"""The picture of a run: the walk from above, and the paper's panels over one time axis."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cowalk.sim.basics.motion import Array

from ..expect.verdict import explain
from ..result import LOST_FOOTING, how_it_ended
from ..trace.sensor_faults import sensor_faults
from .panels import PAPER_PANELS, columns, draw_panels
from .paper import draw_paper_panels, draw_utility_loss
from .style import AGREED, FAULT, house_style, legend_above, new_figure, save
from .top_view import draw_bodies, draw_top_view, window_of

if TYPE_CHECKING:
    from ..result import RunResult

__all__ = ["draw_paper_panels", "draw_run", "draw_utility_loss", "run_figure"]

WIDTH = 10.0
"""Width of the picture in inches; 1400 pixels at `DPI`."""
DPI = 140
HEADING_LINE, LINE = 115, 150
"""Characters in a line of the heading and of the footer."""
VARIES = 0.01
"""A velocity that stays within this, m/s, was not negotiated and gets no panel."""


def draw_run(result: RunResult, file: Path | BinaryIO) -> None:
    """Write the picture of a run as PNG; the same run gives the same bytes.

    Parameters
    ----------
    result : RunResult
        Of any length; columns of which the automation has no opinion may be NaN.
    file : Path or binary stream
    """
    save(run_figure(result), file)


def run_figure(result: RunResult) -> Figure:
    """Return what `draw_run` writes: the top view first, then a panel a quantity."""
    with house_style():
        data = columns(result)
        keys = list(PAPER_PANELS)
        negotiation = result.scenario.automation.negotiation
        if negotiation.dimensions == "both" and _spread(data["est_v"]) > VARIES:
            keys.insert(keys.index("y"), "v")
        window = window_of(result, data)
        strip = float(np.clip((WIDTH - 0.8) * window.aspect, 1.0, 4.5))
        heights = [strip, *(0.8 if key == "v" else 1.05 for key in keys)]
        footer = _footer(result)
        height = sum(heights) + 0.3 * len(heights) + 1.1 + 0.15 * len(footer)
        figure = new_figure(WIDTH, height, DPI)
        above, *axes = figure.subplots(len(heights), 1, height_ratios=heights)
        draw_panels(axes, keys, data)
        draw_top_view(above, result, data, window)
        _mark_closest(above, axes[-1], data)
        _mark_lost_footing(above, data)
        if _early_end(result):
            _mark_end(above, axes, result, data)
        for axis in (above, axes[-1]):
            legend_above(axis)
        color = AGREED if result.passed else FAULT
        figure.suptitle(
            _heading(result), x=0.012, ha="left", size=10.0, color=color, parse_math=False
        )
        # Names and messages are the user's: a dollar sign in them is no formula.
        figure.supxlabel("\n".join(footer), x=0.012, ha="left", size=8.0, parse_math=False)
        return figure


def _spread(values: Array) -> float:
    known = values[np.isfinite(values)]
    return float(np.ptp(known)) if known.size else 0.0


def _heading(result: RunResult) -> str:
    scenario = result.scenario
    parts: tuple[str, ...] = (
        f"plant {scenario.plant.name}",
        f"human {scenario.human.name}",
        f"automation {scenario.automation.name}",
        f"seed {scenario.seed}",
    )
    if _early_end(result):
        parts += ("ENDED EARLY",)
    if result.summary.get("footing_lost_s") is not None:
        parts += (LOST_FOOTING.upper(),)
    failed = sum(not verdict.passed for verdict in result.verdicts)
    if failed:
        parts += (f"{failed} of {len(result.verdicts)} expectations FAILED",)
    return textwrap.fill(f"{scenario.name}:  " + ",  ".join(parts), HEADING_LINE)


def _early_end(result: RunResult) -> str | None:
    """Return why the run did not go its whole way, or None if it did."""
    if result.error is not None:
        return result.error or "no reason given"
    early = result.summary.get("end") in ("collision", "grip lost", LOST_FOOTING)
    return how_it_ended(result.summary) if early else None


def _footer(result: RunResult) -> list[str]:
    reason = _early_end(result)
    lines = textwrap.wrap(f"ended early: {reason}", LINE) if reason else []
    if faults := sensor_faults(result.summary):
        lines += textwrap.wrap(f"sensor: {faults}", LINE)
    for verdict in result.verdicts:
        word = "pass" if verdict.passed else "FAIL"
        lines += textwrap.wrap(
            f"{word}   {verdict.name}: {verdict.formula}   ({explain(verdict)})",
            LINE,
            subsequent_indent=" " * 12,
        )
    return lines


def _mark_closest(above: Axes, axis: Axes, data: dict[str, Array]) -> None:
    clearance = data["clearance"]
    # Infinite where nothing is around, NaN where nothing was measured.
    known = np.isfinite(clearance)
    if not known.any():
        return
    row = int(np.argmin(np.where(known, clearance, np.inf)))
    gap = clearance[row]
    label = f"closest: {gap:.2f} m clear" if gap >= 0.0 else f"overlap: {-gap:.2f} m"
    look: dict[str, Any] = {"marker": "v", "ms": 6.0, "ls": "none", "zorder": 8, "clip_on": False}
    look["color"] = AGREED if gap >= 0.0 else FAULT
    axis.plot(data["t"][row], data["offset"][row], label=label, **look)
    above.plot(data["x"][row], data["y"][row], scalex=False, scaley=False, **look)


def _mark_lost_footing(above: Axes, data: dict[str, Array]) -> None:
    lost = np.flatnonzero(data["footing_held"] == 0.0)[:1]
    if len(lost):
        look: dict[str, Any] = {"marker": "X", "ms": 7.0, "ls": "none", "zorder": 9}
        place = data["human_x"][lost], data["human_y"][lost]
        above.plot(*place, color=FAULT, label=LOST_FOOTING, scalex=False, scaley=False, **look)


def _mark_end(above: Axes, axes: Sequence[Axes], result: RunResult, data: dict[str, Array]) -> None:
    end = float(data["t"][-1]) if len(data["t"]) else 0.0
    draw_bodies(above, result, data, np.arange(len(data["t"]))[-1:], FAULT)
    # What is missing shows, but never shrinks what there is by more than a fifth.
    right = min(result.scenario.duration, 1.25 * end) if end else result.scenario.duration
    axes[0].set_xlim(0.0, max(right, 1.02 * end))
    for axis in axes:
        axis.axvline(end, color=FAULT, lw=1.2, zorder=7)
        axis.axvspan(end, 2.0 * right + 1.0, color="#EFEFEF", lw=0.0, zorder=0)
    look: dict[str, Any] = {"textcoords": "offset points", "color": FAULT, "fontweight": "bold"}
    axes[0].annotate(
        f"ended at {end:.4g} s",
        (end, 0.96),
        xytext=(4, 0),
        va="top",
        xycoords=("data", "axes fraction"),
        **look,
    )
    if len(data["t"]):
        place = data["x"][-1], data["y"][-1]
        above.plot(
            *place,
            scalex=False,
            scaley=False,
            marker="X",
            ms=8.0,
            mfc=FAULT,
            mec="white",
            ls="none",
            zorder=9,
            label="ended here",
        )
