"""A drawing of the scene from above: matplotlib without pyplot, so nothing global is touched."""

from __future__ import annotations

import io
import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrow, Polygon, Rectangle
from numpy.typing import NDArray

from ..plant.protocol import PlantState
from ..world.footprint import corners, furniture, walls
from ..world.outline import Bodies
from ..world.world import World

SPAN = 6.0
"""Width of the ground in the picture, m."""
METRES_PER_NEWTON = 0.1
"""Length of the force arrow."""

FLOOR, WALL, PATH = "#f2f0ec", "#5c5f66", "#8c8f96"
BASE, HEADING, HUMAN, HEAD, FORCE = "#0d7390", "#ffffff", "#b8383a", "#3f2a1c", "#e8890c"
LOAD, ARM = "#d9cc9e", "#dead8a"
HEAD_RADIUS = 0.1
"""m."""
PUDDLE, SOLID, PASSER = "#4c9be8", "#7a6a58", "#4f8a5b"


def window(
    world: World, state: PlantState, width: int, height: int
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return world x at the picture's left and right edge, and world y at its bottom and top, m."""
    x, y, _ = state.pose
    half_height = SPAN / 2.0 * height / width
    centre = 0.0 if world.corridor and world.corridor.width < 2.0 * half_height else y
    return (x - SPAN * 0.4, x + SPAN * 0.6), (centre - half_height, centre + half_height)


def draw(
    world: World, state: PlantState, bodies: Bodies, width: int, height: int, force: bool = True
) -> NDArray[np.uint8]:
    """Draw walls, path, obstacles, the bodies and the force on the base, seen from above.

    The picture follows the base; world x points right and y up.

    Parameters
    ----------
    world : World
        What is on the ground.
    state : PlantState
        The last sample of its force is drawn.
    bodies : Bodies
        Whose outlines are drawn.
    width, height : int
        Size in pixels.
    force : bool
        Whether to draw it.

    Returns
    -------
    ndarray, shape (height, width, 3), uint8
    """
    figure = Figure(figsize=(width / 100.0, height / 100.0), dpi=100)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), facecolor=FLOOR)
    x, y, theta = state.pose
    across, along = window(world, state, width, height)
    axes.set_xlim(*across)
    axes.set_ylim(*along)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.spines[:].set_visible(False)

    _ground(axes, world)
    for walker in world.pedestrians:
        _person(axes, *walker.state(state.time), walker.radius)
    back, front, right, left = _draw_bodies(axes, bodies, state)
    # An arrowhead inside the base's outline.
    length, breadth = 0.5 * (front - back), right - left
    nose = np.array([[0.0, 0.0], [-0.64, 0.46], [-0.64, -0.46]]) * (0.5 * length, 0.5 * breadth)
    nose += (front - 0.07 * (front - back), 0.5 * (left + right))
    cos, sin = math.cos(theta), math.sin(theta)
    turn = np.array([[cos, sin], [-sin, cos]])
    axes.add_patch(Polygon(nose @ turn + (x, y), facecolor=HEADING, zorder=5))
    arrow = state.force_on_base[-1] @ turn * METRES_PER_NEWTON
    if force and np.hypot(*arrow) > 0.02:
        axes.add_patch(
            FancyArrow(
                x,
                y,
                *arrow,
                width=0.05,
                head_width=0.16,
                length_includes_head=True,
                facecolor=FORCE,
                edgecolor="white",
                zorder=6,
            )
        )
    pixels = io.BytesIO()
    figure.savefig(pixels, format="rgba", dpi=100)
    picture = np.frombuffer(pixels.getvalue(), dtype=np.uint8).reshape(height, width, 4)
    return picture[..., :3].copy()


def _ground(axes: Axes, world: World) -> None:
    left, right = axes.get_xlim()
    bottom, top = axes.get_ylim()
    if world.corridor:
        half = world.corridor.width / 2.0
        for edge, end in ((half, max(top, half + 1.0)), (min(bottom, -half - 1.0), -half)):
            axes.add_patch(
                Rectangle((left, edge), right - left, end - edge, facecolor=WALL, zorder=2)
            )
        for branch in world.corridor.side_corridors:
            low = half if branch.side == "left" else -half - branch.length
            place = (branch.x - branch.width / 2.0, low)
            axes.add_patch(
                Rectangle(place, branch.width, branch.length, facecolor=FLOOR, zorder=2.1)
            )
    for box in walls(world):
        axes.add_patch(Polygon(corners(box), facecolor=WALL, zorder=2.2))
    for item in world.furniture:
        axes.add_patch(Polygon(corners(furniture(item)), facecolor=SOLID, zorder=3))
    stations = np.linspace(left - right, world.path.length + right - left, 400)
    axes.plot(*world.path.point_at(stations).T, "--", color=PATH, linewidth=1.5, zorder=1)
    for thing in world.obstacles:
        axes.add_patch(
            Circle(
                (thing.x, thing.y),
                thing.radius,
                facecolor=SOLID if thing.solid else PUDDLE,
                alpha=1.0 if thing.solid else 0.6,
                zorder=3 if thing.solid else 1.5,
            )
        )


def _person(axes: Axes, x: float, y: float, vx: float, vy: float, radius: float) -> None:
    axes.add_patch(Circle((x, y), radius, facecolor=PASSER, edgecolor="white", zorder=4))
    axes.add_patch(Circle((x, y), radius * 0.45, facecolor=HEAD, zorder=5))
    if vx or vy:
        axes.add_patch(FancyArrow(x, y, vx, vy, width=0.03, facecolor=PASSER, lw=0, zorder=3.9))


def _draw_bodies(
    axes: Axes, bodies: Bodies, state: PlantState
) -> tuple[float, float, float, float]:
    """Draw the outlines of the bodies; return the box around the base's, base axes, m."""
    colours = {"base": BASE, "human": HUMAN, "load": LOAD}
    for (name, outline), pose in zip(bodies.outlines.items(), state.poses, strict=True):
        axes.add_patch(
            Polygon(outline.at(pose), facecolor=colours[name], edgecolor="white", zorder=4)
        )
    for arm in bodies.arms:
        axes.add_patch(Polygon(arm.at(state.human_pose), facecolor=ARM, zorder=4.5))
    axes.add_patch(Circle(state.human_pose[:2], HEAD_RADIUS, facecolor=HEAD, zorder=5))
    return bodies.outlines["base"].box
