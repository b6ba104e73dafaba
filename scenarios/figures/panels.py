"""The time panels of a run: what stands in each, and how it is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from cowalk.sim.basics.motion import Array

from .style import (
    AGREED,
    AUTOMATION,
    HUMAN,
    HUMAN_DARK,
    HUMAN_FORWARD,
    HUMAN_FORWARD_DARK,
    MUTED,
    label_unit,
    legend_above,
)

if TYPE_CHECKING:
    from ..result import RunResult

TRUTH: dict[str, Any] = {"lw": 4.5, "alpha": 0.35, "solid_capstyle": "butt"}
"""A pale band under the estimates, so that both stay visible where they coincide."""
FORWARD_INTENT: dict[str, Any] = {"color": HUMAN_FORWARD_DARK, "ls": "--", "lw": 1.0}
HELD: dict[str, Any] = {"drawstyle": "steps-pre"}
"""A row's decision was in force during the control step that ends at the row's time."""


class Curve(NamedTuple):
    """A column, its label, and how it is drawn; an optional one is left out if all zero."""

    column: str
    label: str
    style: dict[str, Any]
    optional: bool = False


@dataclass(frozen=True)
class Panel:
    """A time panel: title, label of the vertical axis, curves, and fixed limits if any.

    ``reach`` is the distance from zero that the axis shows at least, so that noise about
    nothing is not blown up; 0 leaves the axis to the data.
    """

    title: str
    unit: str
    curves: tuple[Curve, ...]
    limits: tuple[float, float] | None = None
    ticks: tuple[float, ...] = ()
    reach: float = 0.0


def _twist_curves(name: str, symbol: str) -> tuple[Curve, ...]:
    return (
        Curve(f"true_{name}", f"${symbol}_H$ true", {"color": HUMAN, **TRUTH}),
        Curve(f"est_{name}", rf"$\hat{{{symbol}}}_H$ estimated", {"color": HUMAN, **HELD}),
        Curve(f"wish_{name}", f"${symbol}_A^*$ wish", {"color": AUTOMATION, **HELD}),
        Curve(f"{name}", "executed", {"color": AGREED}),
        Curve(
            f"{name}_cmd",
            f"${symbol}_A$ agreed",
            {"color": AGREED, "ls": (0, (3, 1.5)), "lw": 1.0, **HELD},
        ),
    )


def _stubbornness_curves(name: str, symbol: str, color: str) -> tuple[Curve, ...]:
    x = rf"x_{symbol}", rf"\hat{{x}}_{symbol}"
    forward = name == "v"
    dark = HUMAN_FORWARD_DARK if forward else HUMAN_DARK
    return (
        Curve(f"true_stubbornness_{name}", f"${x[0]}$ true", {"color": color, **TRUTH}, forward),
        Curve(
            f"est_stubbornness_{name}",
            f"${x[1]}$ estimated",
            {"color": color, "lw": 1.0, **HELD},
            forward,
        ),
        Curve(
            f"smoothed_stubbornness_{name}",
            f"${x[1]}$ smoothed",
            {"color": dark, "lw": 1.5, **HELD},
            forward,
        ),
    )


PANELS: dict[str, Panel] = {
    "force": Panel(
        "Interaction force",
        "force (N)",
        (
            Curve("fx", "$F_x$ measured", {"color": HUMAN_FORWARD, "lw": 1.0}, True),
            Curve("fy", "$F_y$ measured", {"color": HUMAN}),
            Curve("fx_intent", "$F_x$ intended", FORWARD_INTENT, True),
            Curve("fy_intent", "$F_y$ intended", {"color": HUMAN_DARK, "ls": "--", "lw": 1.0}),
        ),
        reach=1.0,
    ),
    "stubbornness": Panel(
        "Stubbornness",
        "stubbornness (1)",
        (
            *_stubbornness_curves("v", "v", HUMAN_FORWARD),
            *_stubbornness_curves("omega", r"\omega", HUMAN),
        ),
        (-0.03, 1.05),
        (0.0, 0.5, 1.0),
    ),
    "target_utility": Panel(
        "Target utility",
        "utility (1)",
        (Curve("target_utility", r"$U_\mathrm{target}$", {"color": AUTOMATION, **HELD}),),
        (-0.03, 1.05),
        (0.0, 0.5, 1.0),
    ),
    "omega": Panel(
        "Angular velocity", r"$\omega$ (rad/s)", _twist_curves("omega", r"\omega"), reach=0.1
    ),
    "v": Panel("Forward velocity", "$v$ (m/s)", _twist_curves("v", "v")),
    "y": Panel(
        "Lateral offset", "$y$ (m)", (Curve("offset", "base", {"color": AGREED}),), reach=0.1
    ),
}
PAPER_PANELS = ("force", "stubbornness", "target_utility", "omega", "y")


def columns(result: RunResult) -> dict[str, Array]:
    """Return the trace's columns and ``offset``, the base's lateral offset from the path in m."""
    data = result.trace.columns()
    pose = np.stack((data["x"], data["y"], data["theta"]), axis=-1)
    data["offset"] = result.scenario.world.path.relative_pose(pose)[..., 1]
    return data


def draw_panels(axes: Sequence[Axes], keys: Sequence[str], data: dict[str, Array]) -> None:
    """Draw panels of `PANELS` one below the other, over one time axis.

    Parameters
    ----------
    axes : sequence of Axes
        From top to bottom, one a key.
    keys : sequence of str
        Keys of `PANELS`.
    data : dict of ndarray, each of shape (rows,)
        What `columns` returns.
    """
    for letter, axis, key in zip("abcdefgh", axes, keys, strict=False):
        panel = PANELS[key]
        _draw_curves(axis, panel.curves, data)
        axis.set_title(f"{letter}) {panel.title}")
        label_unit(axis, panel.unit)
        if panel.limits:
            axis.set_ylim(panel.limits)
            axis.set_yticks(panel.ticks)
        if panel.reach:
            axis.axhline(0.0, color=MUTED, lw=0.6, zorder=1)
            low, high = axis.get_ylim()
            axis.set_ylim(min(low, -panel.reach), max(high, panel.reach))
        axis.tick_params(labelbottom=axis is axes[-1])
        if axis is not axes[0]:
            axis.sharex(axes[0])
    axes[-1].set_xlabel("time (s)")
    end = data["t"][-1] if len(data["t"]) else 0.0
    axes[0].set_xlim(0.0, end if end > 0.0 else 1.0)


def _draw_curves(axis: Axes, curves: Sequence[Curve], data: dict[str, Array]) -> None:
    for column, label, style, optional in curves:
        values = data[column]
        known = np.isfinite(values)
        if not known.any() or (optional and not np.any(values[known])):
            continue
        # A line through a single point is invisible.
        dot = "o" if np.count_nonzero(known) == 1 else ""
        line = np.where(known, values, np.nan)
        axis.plot(data["t"], line, label=label, marker=dot, ms=3.5, clip_on=not dot, **style)
    legend_above(axis)
    if not axis.lines:  # An automation without an opinion, or a run that never began.
        axis.text(0.5, 0.5, "nothing recorded", color=MUTED, ha="center", transform=axis.transAxes)
