"""A run seen from above: the world, the walked paths, and what both sides wanted on the way."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.patches import Circle, Polygon, Rectangle
from numpy.typing import NDArray

from cowalk.sim.basics.motion import Array, arc_displacement, compose
from cowalk.sim.world.footprint import corners, furniture, walls

from .panels import TRUTH
from .style import AGREED, AUTOMATION, HUMAN, MUTED, halo, label_unit

if TYPE_CHECKING:
    from cowalk.sim.world.outline import Outline
    from cowalk.sim.world.world import World

    from ..result import RunResult

Rows = NDArray[np.intp]
"""Row numbers of a trace."""
PASSER = "#4F8A5B"
MARGIN = 0.2
"""Ground shown beyond walls, obstacles and bodies, m."""
FOOTPRINTS = 12
"""Footprints drawn along a run, at most."""
WISHES: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("true", "$p_H$ true", {"color": HUMAN, "linewidth": TRUTH["lw"], "alpha": TRUTH["alpha"]}),
    ("est", r"$\hat{p}_H$ estimated", {"color": HUMAN, "linewidth": 1.3}),
    ("wish", "$p_A^*$", {"color": AUTOMATION, "linewidth": 1.3}),
)
"""Prefix of the trace columns, label and look of each wish; the first lies undermost."""


POSES = {
    "base": ("x", "y", "theta"),
    "human": ("human_x", "human_y", "human_theta"),
    "load": ("x", "y", "theta"),
}
"""Columns of the pose that each outline follows: a load is held by the base."""
OUTLINE_COLOURS = {"base": AGREED, "human": HUMAN, "load": MUTED}


class Window(NamedTuple):
    """The ground that is shown, in m."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def aspect(self) -> float:
        """Height over width."""
        return (self.top - self.bottom) / (self.right - self.left)


def window_of(result: RunResult, data: dict[str, Array]) -> Window:
    """Return the ground that holds the walls, every obstacle, and the bodies all the way."""
    world = result.scenario.world
    discs = [(o.x, o.y, o.radius) for o in world.obstacles]
    discs.append((*world.start[:2], result.outlines["base"].reach))
    for item in world.furniture:
        discs += [(x, y, 0.0) for x, y in corners(furniture(item))]
    for walker in world.pedestrians:
        discs += [(x, y, walker.radius) for x, y in walker.waypoints]
    for wall in world.walls:
        discs += [(*end, wall.thickness) for end in (wall.start, wall.end)]
    rows = np.array(discs)
    for name, outline in result.outlines.items():
        x, y, _ = (data[column] for column in POSES[name])
        known = np.isfinite(x) & np.isfinite(y)
        body = np.stack((x, y, np.full(len(known), outline.reach)), axis=-1)
        rows = np.concatenate((rows, body[known]))
    low = np.min(rows[:, :2] - rows[:, 2:], axis=0) - MARGIN
    high = np.max(rows[:, :2] + rows[:, 2:], axis=0) + MARGIN
    if world.corridor:
        half = world.corridor.width / 2.0 + MARGIN
        low[1], high[1] = min(low[1], -half), max(high[1], half)
    return Window(low[0], high[0], low[1], high[1])


def draw_top_view(axis: Axes, result: RunResult, data: dict[str, Array], window: Window) -> None:
    """Draw a run from above, to scale.

    Parameters
    ----------
    axis : Axes
        Where to.
    result : RunResult
        Its scenario gives the world and the horizon of the wishes.
    data : dict of ndarray, each of shape (rows,)
        The trace's columns.
    window : Window
        What to show at least.
    """
    _draw_world(axis, result.scenario.world, window)
    axis.plot(data["x"], data["y"], color=AGREED, lw=1.6, zorder=4, label="base")
    axis.plot(
        data["human_x"], data["human_y"], color=HUMAN, ls="--", lw=1.3, zorder=4, label="human"
    )
    horizon = result.scenario.automation.negotiation.horizon
    times, rows, stride = _footprints(data["t"], horizon)
    draw_bodies(axis, result, data, rows)
    _draw_wishes(axis, data, rows[::stride], horizon)
    _draw_times(axis, result.outlines["base"], data, rows[::stride], times[::stride])
    axis.set_title("Top view")
    label_unit(axis, "$y$ (m)")
    axis.set_xlabel("$x$ (m)", labelpad=1.0)
    axis.grid(visible=False)
    # A window that does not fill its box shows more ground instead of a smaller picture:
    # auto leaves the limits open to that.
    axis.set_xlim(window.left, window.right, auto=True)
    axis.set_ylim(window.bottom, window.top, auto=True)
    axis.set_aspect("equal", adjustable="datalim")


def _draw_world(axis: Axes, world: World, window: Window) -> None:
    if world.corridor:
        half = world.corridor.width / 2.0
        # Far beyond the window, which may grow to fill its box.
        for wall, beyond in ((-half, -1000.0), (half, 1000.0)):
            axis.axhspan(wall, beyond, color="#D9D9D9", lw=0.0, zorder=0)
        for branch in world.corridor.side_corridors:
            low = half if branch.side == "left" else -half - branch.length
            place = (branch.x - branch.width / 2.0, low)
            axis.add_patch(Rectangle(place, branch.width, branch.length, color="white", zorder=0))
    for box in walls(world, 1000.0):
        axis.add_patch(Polygon(corners(box), color=AGREED, lw=0.0, zorder=1))
    for item in world.furniture:
        axis.add_patch(Polygon(corners(furniture(item)), fc="#6B6B6B", ec=AGREED, lw=0.8, zorder=1))
        _write(axis, item.kind + _unseen(item.seen_by), (item.x, item.y), above=False)
    for walker in world.pedestrians:
        axis.plot(*zip(*walker.waypoints, strict=True), color=PASSER, lw=1.0, ls=":", zorder=2)
        axis.add_patch(Circle(walker.waypoints[0], walker.radius, fc=PASSER, lw=0.0, zorder=2))
        place = (walker.waypoints[0][0], walker.waypoints[0][1] - walker.radius)
        _write(axis, "pedestrian" + _unseen(walker.seen_by), place, above=False)
    reach = 10.0 * (window.right - window.left + window.top - window.bottom)
    path = world.path
    knots = path.point_at(np.array([-reach, path.length + reach]))
    points = np.concatenate((knots[:1], np.asarray(path.points), knots[1:]))
    axis.plot(*points.T, color=AUTOMATION, ls=(0, (1, 2)), lw=1.2, zorder=1, label="path")
    for obstacle in world.obstacles:
        look: dict[str, Any] = (
            {"facecolor": "#6B6B6B", "edgecolor": AGREED}
            if obstacle.solid
            else {"facecolor": "#CFE8F3", "edgecolor": "#5B8FA8", "hatch": "////"}
        )
        centre = (obstacle.x, obstacle.y)
        axis.add_patch(Circle(centre, obstacle.radius, lw=0.8, zorder=1, **look))
        place = (centre[0], centre[1] - obstacle.radius)
        _write(axis, obstacle.kind + _unseen(obstacle.seen_by), place, above=False)


def _unseen(seen_by: tuple[str, ...]) -> str:
    """Return whom a thing is seen by alone, or nothing."""
    return "" if len(seen_by) > 1 else f" (seen by {' '.join(seen_by) or 'no one'})"


def _footprints(t: Array, horizon: float) -> tuple[Array, Rows, int]:
    """Return times and rows at which bodies are drawn, and every how many of them wishes are."""
    if not len(t):
        return np.zeros(0), np.zeros(0, dtype=np.intp), 1
    steps = np.array([1.0, 2.0, 5.0]) * 10.0 ** np.arange(-3, 5)[:, None]
    interval = next(step for step in steps.flat if step >= max(t[0], t[-1] / FOOTPRINTS))
    times = np.arange(0.0, t[-1] + 1e-9, interval)
    rows, first = np.unique(np.searchsorted(t, times - 1e-9), return_index=True)
    # Consecutive arcs of one kind would run into each other below one horizon.
    return times[first], rows, max(1, int(np.ceil(1.3 * horizon / interval)))


def draw_bodies(
    axis: Axes, result: RunResult, data: dict[str, Array], rows: Rows, colour: str | None = None
) -> None:
    """Draw the outlines of all bodies at some rows of a trace, in a colour or each in its own."""
    poses = {
        name: np.stack([data[column] for column in POSES[name]], axis=-1)[rows]
        for name in result.outlines
    }
    for name, outline in result.outlines.items():
        bodies = [
            Polygon(outline.at(pose)) for pose in poses[name].tolist() if np.isfinite(pose).all()
        ]
        shapes = PatchCollection(
            bodies,
            facecolor="none",
            edgecolor=colour or OUTLINE_COLOURS[name],
            lw=0.7,
            alpha=0.6,
            zorder=3,
        )
        axis.add_collection(shapes, autolim=False)
    base, human = poses["base"][:, :2], poses["human"][:, :2]
    # The arm: which two footprints belong together.
    arms = np.stack((base, human), axis=1)
    axis.add_collection(LineCollection(list(arms), color=MUTED, lw=0.6, zorder=2), autolim=False)


def _draw_wishes(axis: Axes, data: dict[str, Array], rows: Rows, horizon: float) -> None:
    poses = np.stack((data["x"], data["y"], data["theta"]), axis=-1)[rows]
    # The wishes held from a row's pose onwards are those of the next row.
    after = np.minimum(rows + 1, len(data["t"]) - 1)
    durations = np.linspace(0.0, horizon, 25)
    for order, (prefix, label, look) in enumerate(WISHES):
        twists = np.stack((data[f"{prefix}_v"], data[f"{prefix}_omega"]), axis=-1)[after]
        known = np.isfinite(twists).all(axis=-1) & np.isfinite(poses).all(axis=-1)
        if not known.any():
            continue
        ways = arc_displacement(twists[known][:, None, :], durations)
        arcs = compose(poses[known][:, None, :], ways)[..., :2]
        axis.add_collection(
            LineCollection(list(arcs), label=label, zorder=5 + order, **look), autolim=False
        )
        if "alpha" not in look:
            axis.scatter(
                arcs[:, -1, 0], arcs[:, -1, 1], s=9.0, color=look["color"], zorder=5 + order, lw=0.0
            )


def _draw_times(
    axis: Axes, base: Outline, data: dict[str, Array], rows: Rows, times: Array
) -> None:
    for row, time in zip(rows, times, strict=True):
        pose = data["x"][row], data["y"][row], data["theta"][row]
        if np.isfinite(pose).all():
            place = pose[0], float(base.at(pose)[:, 1].max())
            _write(axis, f"{time:g} s", place, above=True)


def _write(axis: Axes, text: str, place: tuple[float, float], above: bool) -> None:
    axis.annotate(
        text,
        place,
        xytext=(0, 2 if above else -2),
        textcoords="offset points",
        ha="center",
        va="bottom" if above else "top",
        fontsize=7.0,
        color=AGREED,
        path_effects=halo(),
        parse_math=False,
        zorder=9,
        annotation_clip=True,
    )
