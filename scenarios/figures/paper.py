"""The figures of arXiv 2407.17275: the five panels with its reported values, and U_loss."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cowalk.estimation.laws.stubbornness import utility_loss

from .panels import PAPER_PANELS, columns, draw_panels
from .style import AUTOMATION, REPORTED, halo, house_style, legend_above, new_figure, save

if TYPE_CHECKING:
    from ..result import RunResult

Mark = tuple[str, float, float, str]
"""A reported value: key of its panel, t in s, value, label."""
DASHES: dict[str, Any] = {"color": REPORTED, "ls": (0, (2, 2)), "lw": 1.1}
DIAMOND: dict[str, Any] = {"marker": "D", "ms": 5.5, "mfc": "none", "mec": REPORTED, "mew": 1.4}


def draw_paper_panels(result: RunResult, file: Path, marks: Sequence[Mark] = ()) -> None:
    """Write the paper's five panels as PNG, reported values marked on the curves.

    Parameters
    ----------
    result : RunResult
        The open-loop scenario's.
    file : Path
        Name of the PNG.
    marks : sequence of (panel, t, value, label)
        Panel is "force", "stubbornness", "target_utility", "omega" or "y". Each mark stands
        at ``t`` (s) and ``value`` (the panel's unit); where the value is NaN, it is the time
        that is reported.
    """
    save(paper_figure(result, marks), file)


def paper_figure(result: RunResult, marks: Sequence[Mark] = ()) -> Figure:
    """Return what `draw_paper_panels` writes.

    Raises
    ------
    KeyError
        If a mark names no panel of the figure.
    """
    with house_style():
        figure = new_figure(7.0, 8.6, dpi=200)
        axes = figure.subplots(len(PAPER_PANELS), 1)
        draw_panels(axes, PAPER_PANELS, columns(result))
        by_key = dict(zip(PAPER_PANELS, axes, strict=True))
        for key in dict.fromkeys(mark[0] for mark in marks):
            _draw_marks(by_key[key], [mark for mark in marks if mark[0] == key])
        if marks:
            axes[0].plot([], [], label="reported in the paper", **DASHES, **DIAMOND)
            legend_above(axes[0])
        return figure


def _draw_marks(axis: Axes, marks: Sequence[Mark]) -> None:
    values = np.array([mark[1:3] for mark in marks])
    timed = np.isnan(values[:, 1])
    for moment in values[timed, 0]:
        axis.axvline(moment, **DASHES, zorder=5)
    if not timed.all():  # An unclipped line without points would upset the layout.
        axis.plot(*values[~timed].T, zorder=6, clip_on=False, ls="none", **DIAMOND)
    low, high = axis.get_ylim()
    for (_, t, value, label), is_time in zip(marks, timed, strict=True):
        # Two marks close by: the earlier is labelled to its left, the later to its right.
        gaps = values[~timed, 0] - t
        left = not is_time and bool(np.any((gaps > 0.0) & (gaps < 0.1 * axis.get_xlim()[1])))
        height = high if is_time else value
        above = height < low + 0.7 * (high - low)
        axis.annotate(
            label,
            (t, height),
            xytext=(-6 if left else 6, 5 if above else -5),
            textcoords="offset points",
            ha="right" if left else "left",
            va="bottom" if above else "top",
            color=REPORTED,
            fontsize=8.0,
            path_effects=halo(),
            zorder=7,
        )


def draw_utility_loss(
    file: Path, settings: Sequence[tuple[float, float]] = ((-2.0, 2.0), (-1.0, 1.0), (0.0, 2.0))
) -> None:
    """Write U_loss over the smoothed interaction value as PNG, one curve a setting.

    Parameters
    ----------
    file : Path
        Name of the PNG.
    settings : sequence of (interaction_min, interaction_max)
        Sensitivities, at most four to be told apart.
    """
    save(utility_loss_figure(settings), file)


def utility_loss_figure(settings: Sequence[tuple[float, float]]) -> Figure:
    """Return what `draw_utility_loss` writes."""
    with house_style():
        figure = new_figure(4.6, 3.0, dpi=200)
        axis = figure.subplots()
        interaction = np.linspace(-2.0, 2.0, 401)
        # The automation's own setting: shades of its hue.
        looks = (("#08306B", "-"), (AUTOMATION, "--"), ("#56B4E9", "-."), ("#08306B", ":"))
        for (low, high), (color, dashes) in zip(settings, looks, strict=False):
            axis.plot(
                interaction,
                utility_loss(interaction, low, high),
                color=color,
                ls=dashes,
                lw=1.8,
                label=rf"$\bar{{I}}_\mathrm{{min}}={low:g},\ \bar{{I}}_\mathrm{{max}}={high:g}$",
            )
        axis.set_xlim(-2.0, 2.0)
        axis.set_ylim(-0.03, 1.05)
        axis.set_xlabel(r"smoothed interaction value $\bar{I}$ (1)")
        axis.set_ylabel(r"utility loss $U_\mathrm{loss}$ (1)")
        axis.legend(loc="upper left", borderaxespad=0.6, handlelength=2.8)
        return figure
