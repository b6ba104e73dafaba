"""The pictures of a human model: its answers, its fixed points, and an imperfection alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from cowalk.agents.interfaces import Human
from cowalk.sim.motion import Array

from .figures_style import (
    AUTOMATION,
    HUMAN,
    HUMAN_DARK,
    HUMAN_FORWARD,
    MUTED,
    halo,
    house_style,
    legend_above,
    new_figure,
    save,
)
from .human_answers import Answer, answer, fixed_points, settled_stubbornness

ROBOTS: dict[str, tuple[float, dict[str, Any]]] = {
    "does not yield": (0.0, {"color": HUMAN_DARK, "ls": "-"}),
    "half yields": (0.5, {"color": HUMAN, "ls": "--"}),
    "yields": (1.0, {"color": HUMAN_FORWARD, "ls": "-.", "lw": 1.8}),
}
"""The robots that a human is shown with: their concession, and how their curve is drawn."""
WIDTH, HEIGHT, DPI = 10.0, 6.2, 140
STAGE = (
    "The robot wants straight on at 0.6 m/s, 0.6 m to the right of where the human wants to walk "
    "at 0.8 m/s; it concedes a fixed share of the difference.\nLower right: kept at that offset "
    "for 30 s; “paper” is concession = stubbornness, where the paper's automation comes to rest."
)
CONCESSIONS = np.linspace(0.0, 1.0, 21)
LEAST_FORCE = 1.0
"""A force axis shows at least this far from zero, N."""


def draw_human(human: Human, bare: Human | None, title: str, file: Path) -> list[float]:
    """Write the picture of a human as PNG, and return the fixed points of omega.

    Parameters
    ----------
    human : Human
    bare : Human or None
        The same without imperfections, drawn beneath in grey.
    title : str
        Heading.
    file : Path
    """
    settled = settled_stubbornness(human, CONCESSIONS)
    meeting = fixed_points(CONCESSIONS, settled[:, 1])
    with house_style():
        figure = new_figure(WIDTH, HEIGHT, DPI)
        panels = figure.subplots(2, 2, width_ratios=(1.5, 1.0))
        for name, (concession, style) in ROBOTS.items():
            if bare is not None:
                unspoilt = answer(bare, concession)
                _curves(panels, unspoilt, {"color": MUTED, "lw": 0.8, "ls": style["ls"]})
            _curves(panels, answer(human, concession), style | {"label": f"robot {name}"})
        _label(panels[0, 0], "sideways force", "N", True)
        _label(panels[1, 0], "forward force", "N", True)
        _label(panels[0, 1], "stubbornness in ω", "share", False)
        _share_axis(panels[0, 1])
        legend_above(panels[0, 0])
        for axis in (*panels[:, 0], panels[0, 1]):
            axis.set_xlabel("time in s")
        _settled_panel(panels[1, 1], settled, meeting)
        figure.suptitle(title, x=0.012, ha="left", size=10.0, parse_math=False)
        figure.supxlabel(STAGE, x=0.012, ha="left", size=8.0)
    save(figure, file)
    return meeting


def draw_imperfection(
    time: Array, asked: Array, given: Sequence[Array], title: str, file: Path
) -> None:
    """Write the picture of imperfections alone, on a push that is prescribed, as PNG.

    Parameters
    ----------
    time : ndarray, shape (steps,)
        s.
    asked : ndarray, shape (steps, 2)
        Force that the human asks for, N.
    given : sequence of ndarray, shape (steps, 2)
        Force of the hand in some runs, N; the first is drawn boldly.
    title : str
        Heading.
    file : Path
    """
    with house_style():
        figure = new_figure(WIDTH, HEIGHT, DPI)
        above, below = figure.subplots(2, 1, height_ratios=(1.6, 1.0), sharex=True)
        above.step(time, asked[:, 1], where="post", color=MUTED, lw=3.0, alpha=0.6, label="asked")
        above.step(time, given[0][:, 1], where="post", color=HUMAN, label="given")
        _label(above, "sideways force, alone on a prescribed push", "N", True)
        legend_above(above)
        for force in given[1:]:
            below.step(time, (force - asked)[:, 1], where="post", color=MUTED, lw=0.6)
        difference = given[0] - asked
        forward = {"color": HUMAN_FORWARD, "ls": "--", "label": "forward"}
        if np.any(difference[:, 0]):
            below.step(time, difference[:, 0], where="post", **forward)
        below.step(time, difference[:, 1], where="post", color=HUMAN, label="sideways")
        _label(below, "given - asked", "N", False)
        legend_above(below)
        below.set_xlabel("time in s")
        figure.suptitle(title, x=0.012, ha="left", size=10.0, parse_math=False)
    save(figure, file)


def _curves(panels: Any, found: Answer, style: dict[str, Any]) -> None:
    shown = ((panels[0, 0], found.force[:, 1]), (panels[1, 0], found.force[:, 0]))
    for axis, values in (*shown, (panels[0, 1], found.stubbornness[:, 1])):
        axis.plot(found.time, values, **style)


def _label(axis: Axes, title: str, unit: str, force: bool) -> None:
    axis.set_title(title)
    axis.set_ylabel(unit)
    if force:
        low, high = axis.get_ylim()
        axis.set_ylim(min(low, -LEAST_FORCE), max(high, LEAST_FORCE))
        axis.axhline(0.0, color=MUTED, lw=0.7, zorder=1.0)


def _share_axis(axis: Axes) -> None:
    axis.set_ylim(-0.03, 1.03)


def _settled_panel(axis: Axes, settled: Array, meeting: list[float]) -> None:
    """Draw settled stubbornness over concession, and where the paper's automation meets it."""
    axis.plot(CONCESSIONS, settled[:, 1], color=HUMAN, label="in ω")
    axis.plot(CONCESSIONS, settled[:, 0], color=HUMAN_FORWARD, ls="--", label="in v")
    axis.plot((0.0, 1.0), (0.0, 1.0), color=AUTOMATION, lw=1.0, label="paper")
    axis.plot(meeting, meeting, "o", color=HUMAN_DARK, ms=6.0, clip_on=False, zorder=4.0)
    for group in _close_together(meeting):
        left = group[0] > 0.7
        axis.annotate(
            ", ".join(f"{point:.2f}" for point in group),
            (group[0], group[0]),
            (-8 if left else 8, -4),
            textcoords="offset points",
            ha="right" if left else "left",
            va="top" if group[0] > 0.1 else "bottom",
            path_effects=halo(),
        )
    _share_axis(axis)
    axis.set_xlabel("concession of the robot, held")
    _label(axis, "settled stubbornness", "share", False)
    legend_above(axis)


def _close_together(points: list[float]) -> list[list[float]]:
    """Return rising points in groups that share a label."""
    groups: list[list[float]] = []
    for point in points:
        if groups and point - groups[-1][-1] < 0.1:
            groups[-1].append(point)
        else:
            groups.append([point])
    return groups
