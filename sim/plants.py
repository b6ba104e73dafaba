"""The plants that ship, by name."""

from __future__ import annotations

from .plant import Plant
from .registry import Registry

PLANTS: Registry[Plant] = Registry(
    "plant",
    {
        "unicycle": "cowalk.sim.unicycle:UnicyclePlant",
        "bullet": "cowalk.sim.bullet:BulletPlant",
    },
    methods=("reset", "step", "render", "close"),
)
