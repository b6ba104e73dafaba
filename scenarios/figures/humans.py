"""The pictures of a human model: its answers, its fixed points, and an imperfection alone."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from cowalk.agents.basics.protocols import Human
from cowalk.sim.basics.motion import Array

from ..people.responses import Answer, answer, fixed_points, settled_stubbornness
from .style import (
    AUTOMATION,
    HUMAN,
    HUMAN_DARK,
    HUMAN_FORWARD,
    MUTED,
    house_style,
    legend_above,
    new_figure,
    save,
)

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
    "until settled, at most 90 s; “paper” is concession = stubbornness, where the paper's "
    "automation rests."
)
CONCESSIONS = np.linspace(0.0, 1.0, 21)
LEAST_FORCE = 1.0
"""A force axis shows at least this far from zero, N."""


def draw_human(human: Human, bare: Human | None, title: str, file: Path) -> dict[str, list[float]]:
    """Write the picture of a human as PNG, and return the fixed points of v and of omega.

    Parameters
    ----------
    human : Human
    bare : Human or None
        The same without imperfections, drawn beneath in grey.
    title : str
        Heading.
    file : Path
    """
    with house_style():
        figure = new_figure(WIDTH, HEIGHT, DPI)
        grid = figure.add_gridspec(2, 3, width_ratios=(1.3, 1.0, 1.1))
        panels = np.array([[figure.add_subplot(grid[i, j]) for j in (0, 1)] for i in (0, 1)])
        for name, (concession, style) in ROBOTS.items():
            if bare is not None:
                unspoilt = answer(bare, concession)
                _curves(panels, unspoilt, {"color": MUTED, "lw": 0.8, "ls": style["ls"]})
            _curves(panels, answer(human, concession), style | {"label": name})
        for row, (force, share) in enumerate((("sideways", "ω"), ("forward", "v"))):
            _label(panels[row, 0], f"{force} force", "N", True)
            _label(panels[row, 1], f"stubbornness in {share}", "share", False)
            _share_axis(panels[row, 1])
        for axis in panels[1]:
            axis.set_xlabel("time in s")
        words = figure.add_subplot(grid[0, 2])
        words.set_axis_off()
        lines = panels[0, 0].get_legend_handles_labels()
        legend = words.legend(*lines, loc="upper left", title="a robot that", alignment="left")
        legend.set_in_layout(False)
        meeting = _settled_panel(figure.add_subplot(grid[1, 2]), words, human)
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
        differences = [force - asked for force in given]
        rows = [("sideways", 1, {"color": HUMAN})]
        if np.any(differences[0][:, 0]):
            rows.append(("forward", 0, {"color": HUMAN_FORWARD}))
        ratios = (1.6, *(1.0 for _ in rows))
        above, *below = figure.subplots(len(ratios), 1, height_ratios=ratios, sharex=True)
        above.step(time, asked[:, 1], where="post", color=MUTED, lw=3.0, alpha=0.6, label="asked")
        above.step(time, given[0][:, 1], where="post", color=HUMAN, label="given")
        _label(above, "sideways force, alone on a prescribed push", "N", True)
        legend_above(above)
        for axis, (name, column, style) in zip(below, rows, strict=True):
            for difference in differences[1:]:
                axis.step(time, difference[:, column], where="post", color=MUTED, lw=0.6)
            axis.step(time, differences[0][:, column], where="post", **style)
            _label(axis, f"given - asked, {name}", "N", False)
        below[-1].set_xlabel("time in s")
        figure.suptitle(title, x=0.012, ha="left", size=10.0, parse_math=False)
    save(figure, file)


def _curves(panels: Any, found: Answer, style: dict[str, Any]) -> None:
    for row, i in enumerate((1, 0)):
        panels[row, 0].plot(found.time, found.force[:, i], **style)
        panels[row, 1].plot(found.time, found.stubbornness[:, i], **style)


def _label(axis: Axes, title: str, unit: str, force: bool) -> None:
    axis.set_title(title)
    axis.set_ylabel(unit)
    if force:
        low, high = axis.get_ylim()
        axis.set_ylim(min(low, -LEAST_FORCE), max(high, LEAST_FORCE))
        axis.axhline(0.0, color=MUTED, lw=0.7, zorder=1.0)


def _share_axis(axis: Axes) -> None:
    axis.set_ylim(-0.03, 1.03)


def _settled_panel(axis: Axes, words: Axes, human: Human) -> dict[str, list[float]]:
    """Draw settled stubbornness, say and return where the paper's automation rests."""
    if not getattr(human, "closed_loop", True):
        axis.set_axis_off()
        words.text(0.0, 0.3, "A prescribed force answers no concession.")
        return {"v": [], "omega": []}
    settled = settled_stubbornness(human, CONCESSIONS)
    styles: dict[str, tuple[int, str, dict[str, Any], dict[str, Any]]] = {
        "v": (
            0,
            "in v",
            {"color": HUMAN_FORWARD, "ls": "--", "zorder": 3.0},
            {"mfc": "white", "mec": HUMAN_FORWARD, "mew": 1.6, "ms": 9.0, "zorder": 4.0},
        ),
        "omega": (
            1,
            "in ω",
            {"color": HUMAN, "zorder": 2.5},
            {"color": HUMAN_DARK, "ms": 6.0, "zorder": 5.0},  # within the ring of v
        ),
    }
    meeting, rests = {}, []
    for name, (i, label, line, mark) in styles.items():
        settle = partial(_settled_share, human, i)
        points, jumps = fixed_points(CONCESSIONS, settled[:, i], settle)
        meeting[name] = points
        breaks = np.searchsorted(CONCESSIONS, jumps)
        axis.plot(
            np.insert(CONCESSIONS, breaks, jumps),
            np.insert(settled[:, i], breaks, np.nan),
            label=label,
            **line,
        )
        if points:
            axis.plot(points, points, "o", ls="none", clip_on=False, **mark)
        texts = [f"{p:.2f}" for p in points] or ["nowhere"]
        texts += [f"jumps past it at {p:.2f}" for p in jumps]
        rests.append(f"{label}: {', '.join(texts)}")
    axis.plot((0.0, 1.0), (0.0, 1.0), color=AUTOMATION, lw=1.0, label="paper")
    _share_axis(axis)
    axis.set_xlabel("concession of the robot, held")
    _label(axis, "settled", "stubbornness, share", False)
    heading = "concession = stubbornness"
    words.text(0.03, 0.02, "\n".join((heading, *rests)), linespacing=1.5)
    legend_above(axis)
    return meeting


def _settled_share(human: Human, i: int, concessions: Array) -> Array:
    return np.asarray(settled_stubbornness(human, concessions)[:, i])
