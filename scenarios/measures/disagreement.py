"""What becomes of each disagreement: resolved in time, too late, by giving in, or never."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cowalk.sim.basics.motion import Array
from cowalk.sim.world.world import World

BREAK = 1.0
"""Agreement shorter than that ends no disagreement, s (inferred): it was passed through."""
LEAST = 0.5
"""Disagreement shorter than that is none, s (inferred): who turns is late by a reaction."""
AHEAD = 8.0
"""How far ahead a thing may lie that a disagreement is about, m (inferred): beyond what any
shipped human looks ahead."""
OUTCOMES = ("resolved in time", "ended at it", "ended after it", "given in", "unresolved")


class Extent(NamedTuple):
    """From where to where a thing lies along the path, m."""

    begins: float
    ends: float


def things_of(world: World) -> list[Extent]:
    """Return what a disagreement may be about: what the human can see, and stands still.

    Pedestrians are left out: they are not where they were when it began.
    """
    seen = [(o.x, o.y, o.radius) for o in world.obstacles if "human" in o.seen_by]
    seen += [
        (box.x, box.y, math.hypot(box.length, box.width) / 2.0)
        for box in world.furniture
        if "human" in box.seen_by
    ]
    extents = []
    for x, y, reach in seen:
        station, _, _ = world.path.relative(x, y, 0.0)
        extents.append(Extent(station - reach, station + reach))
    return extents


@dataclass(frozen=True)
class Disagreement:
    """One episode in which human and base were apart, in one dimension.

    Attributes
    ----------
    first, last : int
        Rows; the last one included.
    about : Extent or None
        The next thing ahead of the base when it began, if the human can see one.
    outcome : str
        One of `OUTCOMES`. ``"resolved in time"``: the base came to the human before they reached
        the thing. ``"given in"``: the human's wish came to the base before that. ``"ended at
        it"``, ``"ended after it"``: it ended while they passed the thing, or later, whoever
        moved: by then that decides nothing. ``"unresolved"``: it had not ended when the run did.
        What is about no thing ends in time or by giving in.
    """

    first: int
    last: int
    about: Extent | None
    outcome: str


def episodes(apart: NDArray[np.bool_], period: float) -> list[tuple[int, int]]:
    """Return first and last row of each episode of disagreement.

    Breaks shorter than `BREAK` are bridged, then episodes shorter than `LEAST` left out, so
    that neither gait nor a wish that passes through zero makes or ends one.

    Parameters
    ----------
    apart : ndarray of bool, shape (rows,)
    period : float
        Control period, s.
    """
    rows = np.flatnonzero(apart)
    if not rows.size:
        return []
    ends = np.flatnonzero(np.diff(rows) * period > BREAK)
    firsts = rows[np.concatenate(([0], ends + 1))]
    lasts = rows[np.concatenate((ends, [rows.size - 1]))]
    found = zip(firsts.tolist(), lasts.tolist(), strict=True)
    return [(first, last) for first, last in found if (last - first + 1) * period >= LEAST]


def disagreements(
    wish: Array,
    executed: Array,
    apart: NDArray[np.bool_],
    station: Array,
    things: Sequence[Extent],
    period: float,
) -> list[Disagreement]:
    """Return every disagreement in one dimension, and how it ended.

    Wanting more than is done is one disagreement, wanting less is another.

    Who moved is judged from the row in which they were farthest apart to the row after the
    last: who went the longer way towards the other.

    Parameters
    ----------
    wish, executed : ndarray, shape (rows,)
        p_H and p, m/s or rad/s.
    apart : ndarray of bool, shape (rows,)
    station : ndarray, shape (rows,)
        Of the base along the path, m.
    things : sequence of Extent
        What the human can see and that stands still.
    period : float
        Control period, s.
    """
    found = []
    gap = wish - executed
    sides = [episodes(apart & (gap * side > 0.0), period) for side in (1.0, -1.0)]
    for first, last in sorted(sides[0] + sides[1]):
        here = float(station[first])
        ahead = [thing for thing in things if thing.ends > here and thing.begins - here < AHEAD]
        about = min(ahead, key=lambda thing: thing.begins, default=None)
        if (len(station) - 1 - last) * period <= BREAK:
            outcome = "unresolved"
        elif about is not None and station[last] > about.ends:
            outcome = "ended after it"
        elif about is not None and station[last] >= about.begins:
            outcome = "ended at it"
        else:
            widest = first + int(np.nanargmax(np.abs(gap[first : last + 1])))
            side = np.sign(gap[widest])
            by_base = side * (executed[last + 1] - executed[widest])
            by_human = side * (wish[widest] - wish[last + 1])
            outcome = "resolved in time" if by_base >= by_human else "given in"
        found.append(Disagreement(first, last, about, outcome))
    return found
