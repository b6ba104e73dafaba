"""What bodies occupy on the floor plan: convex outlines in the body's own axes. Pure."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..basics.motion import Array

Disc = tuple[float, float, float]
"""``(x, y, radius)``, m; a corner is a disc without radius."""

SIDES = 64
"""Corners by which a circle is drawn: they are off by 0.06 % of its radius at most."""
FLAT = 1e-14
"""How far a point may stand out by rounding, as a share of what all of them span."""
_ANGLES = (np.arange(SIDES) + 0.5) * (math.tau / SIDES)
# Half outside, half inside: the error of a polygon of so many sides, on either side of zero.
_GROWN = 2.0 / (1.0 + math.cos(math.pi / SIDES))
_CIRCLE = _GROWN * np.stack((np.cos(_ANGLES), np.sin(_ANGLES)), axis=-1)


@dataclass(frozen=True)
class Outline:
    """The convex hull of discs: a disc, a rectangle (four corners), a capsule, or what is needed.

    Attributes
    ----------
    discs : tuple of (x, y, radius)
        In the body's axes, x forward, y left, m.
    underside : float
        How high above the floor it is, m: it passes over what is lower, puddles too.
    """

    discs: tuple[Disc, ...]
    underside: float = 0.0

    @cached_property
    def polygon(self) -> Array:
        """Its corners, circles by `SIDES` of them, counter-clockwise, shape (n, 2), m."""
        points, _ = _sampled(self.discs)
        return np.asarray(points[hull_corners(points)])

    @property
    def swing(self) -> float:
        """How far its edge moves when it turns by 1 rad, at most, m: none for a centred disc."""
        return max(math.hypot(x, y) for x, y, _ in self.discs)

    @property
    def reach(self) -> float:
        """How far from its origin it reaches, m."""
        return max(math.hypot(x, y) + radius for x, y, radius in self.discs)

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Its least and greatest x, and its least and greatest y, m."""
        discs = self.discs
        return (
            min(x - r for x, _, r in discs),
            max(x + r for x, _, r in discs),
            min(y - r for _, y, r in discs),
            max(y + r for _, y, r in discs),
        )

    def moved(self, pose: tuple[float, float, float]) -> Outline:
        """Return it in the axes in which the body is at a pose (x, y, theta), m, m, rad."""
        x, y, theta = pose
        cos, sin = math.cos(theta), math.sin(theta)
        discs = tuple((x + cos * a - sin * b, y + sin * a + cos * b, r) for a, b, r in self.discs)
        return replace(self, discs=discs)

    def at(self, pose: tuple[float, float, float]) -> Array:
        """Return its `polygon` where the body is at a pose (x, y, theta), shape (n, 2), m."""
        x, y, theta = pose
        cos, sin = math.cos(theta), math.sin(theta)
        return np.asarray(self.polygon @ np.array([[cos, sin], [-sin, cos]]) + (x, y))


@dataclass(frozen=True)
class Bodies:
    """What a plant moves, as far as the world around is concerned.

    Attributes
    ----------
    outlines : dict of str to Outline
        ``"base"``, ``"human"`` and, where there is one, ``"load"``, in the order of
        `cowalk.sim.plant.protocol.PlantState.poses`.
    eyes : dict of str to (x, y, z)
        Where each seat sees from, m: the automation's in base axes, the human's in the trunk's.
    arms : tuple of Outline
        Arms that hold on, in the trunk's axes: nothing solid of their height gets between the two.
    """

    outlines: dict[str, Outline]
    eyes: dict[str, tuple[float, float, float]]
    arms: tuple[Outline, ...] = ()

    @property
    def parts(self) -> tuple[tuple[int, Outline], ...]:
        """Every outline with the number of the pose that it goes with."""
        human = list(self.outlines).index("human")
        return (*enumerate(self.outlines.values()), *((human, arm) for arm in self.arms))


def disc(radius: float) -> Outline:
    """Return a disc around the body's origin."""
    return Outline(((0.0, 0.0, radius),))


def across(breadth: float, depth: float) -> Outline:
    """Return a capsule that lies across: its whole breadth along y, its depth along x, m."""
    radius, half = depth / 2.0, max(0.0, breadth - depth) / 2.0
    return Outline(((0.0, half, radius), (0.0, -half, radius)))


def bar(
    start: tuple[float, float], end: tuple[float, float], radius: float, underside: float
) -> Outline:
    """Return a capsule from one point to another, m."""
    return Outline(((*start, radius), (*end, radius)), underside)


def rectangle(
    back: float, front: float, right: float, left: float, underside: float = 0.0
) -> Outline:
    """Return a rectangle from back to front (along x) and from right to left (along y), m."""
    corners = ((front, left), (back, left), (back, right), (front, right))
    return Outline(tuple((x, y, 0.0) for x, y in corners), underside)


def hull(discs: Iterable[Disc]) -> Outline:
    """Return the outline around discs and corners; those inside it are left out.

    Raises
    ------
    ValueError
        If there are none, or all of them are corners on one line.
    """
    given = tuple(dict.fromkeys(discs))
    points, owners = _sampled(given)
    found = hull_corners(points)
    if len(found) < 3:
        raise ValueError("no outline: nothing, or nothing but a line")
    kept = dict.fromkeys(int(owner) for owner in owners[found])
    return Outline(tuple(given[owner] for owner in kept))


def hull_corners(points: Array) -> NDArray[np.intp]:
    """Return the numbers of the corners of the convex hull of points, counter-clockwise.

    By Andrew's monotone chain (Inf. Process. Lett. 9, 1979), from the corner with the lowest
    number on. SciPy's hull would do, but takes longer to import than a run to start.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        m.

    Returns
    -------
    ndarray, shape (corners,)
        Less than three if the points lie on a line: its ends.
    """
    x: list[float] = points[:, 0].tolist()
    y: list[float] = points[:, 1].tolist()

    def turn(a: int, b: int, c: int) -> float:
        return (x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a])

    def side(order: list[int]) -> list[int]:
        kept: list[int] = []
        for c in order:
            while len(kept) > 1 and turn(kept[-2], kept[-1], c) <= 0.0:
                kept.pop()
            kept.append(c)
        return kept[:-1]

    order = np.lexsort((y, x)).tolist()
    found = [*side(order), *side(order[::-1])] or order[:1]
    # What is left of the edge beside it by rounding alone is no corner. The flattest goes first,
    # since it is the middle one of three on a line whatever the order in which they were met.
    flat = FLAT * float(np.ptp(points, axis=0).max()) if len(points) else 0.0
    while len(found) > 2:
        around = zip(found[-1:] + found[:-1], found, found[1:] + found[:1], strict=True)
        height, flattest = min(
            (turn(a, b, c) / math.hypot(x[c] - x[a], y[c] - y[a]), b) for a, b, c in around
        )
        if height > flat:
            break
        found.remove(flattest)
    first = found.index(min(found)) if found else 0
    return np.array(found[first:] + found[:first], dtype=np.intp)


def _sampled(discs: tuple[Disc, ...]) -> tuple[Array, Array]:
    """Return points on the rims of discs, shape (n, 2), and the number of each one's disc."""
    rows = np.array(discs, dtype=float).reshape(-1, 3)
    round_ones = rows[:, 2] > 0.0
    rims = rows[round_ones, None, :2] + rows[round_ones, 2, None, None] * _CIRCLE
    numbers = np.arange(len(rows))
    points = np.concatenate((rows[~round_ones, :2], rims.reshape(-1, 2)))
    return points, np.concatenate((numbers[~round_ones], np.repeat(numbers[round_ones], SIDES)))
