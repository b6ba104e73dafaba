"""How high things are: who has their eyes above one looks over it. All inferred."""

from __future__ import annotations

WALL_HEIGHT = 2.5
"""Of walls, m (inferred): nobody looks over them."""
USUAL_HEIGHT = 0.8
"""Of what is not in `HEIGHTS`, m (inferred)."""
HEIGHTS = {
    "puddle": 0.0,
    "table": 0.75,
    "desk": 0.75,
    "bench": 0.45,
    "chair": 0.9,
    "bed": 0.6,
    "trolley": 0.9,
    "counter": 0.9,
    "cupboard": 1.8,
    "shelf": 1.8,
    "wardrobe": 2.0,
    "pillar": WALL_HEIGHT,
    "column": WALL_HEIGHT,
}
"""Usual heights by kind, m (inferred), where a thing is not given one."""
PEDESTRIAN_HEIGHT = 1.73
"""Of people who pass, m."""


def usual_height(kind: str) -> float:
    """Return the usual height of a kind of thing, m."""
    return HEIGHTS.get(kind, USUAL_HEIGHT)
