"""A physics step of every way to build the PyBullet plant, beside the bare engine step."""

from __future__ import annotations

import numpy as np

from cowalk.sim.basics.rates import Rates
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.env.env import STRAIGHT_CORRIDOR

from .timing import best

STEPS = 60
OPTIONS = {
    "default": {},
    "gait": {"gait": {"enabled": True}},
    "both hands": {"body": {"hand": "both"}},
    "stiff wrist": {"grip": {"turn_stiffness": (0.0, 0.0, 1.0)}},
    "compliant grip": {"grip": {"kind": "compliant"}},
    "stretcher": {"coupling": {"kind": "stretcher"}},
    "wheels": {"drive": {"kind": "wheels"}},
}


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, value, unit)."""
    plants = {name: BulletPlant(Rates(), **options) for name, options in OPTIONS.items()}
    shortest: dict[str, tuple[float, float]] = {}
    for _ in range(6):  # interleaved, so that a slow moment of the machine hits all of them
        for name, plant in plants.items():
            bare, driven = times(plant)
            old = shortest.get(name, (np.inf, np.inf))
            shortest[name] = (min(bare, old[0]), min(driven, old[1]))
    rows = []
    for name, (bare, driven) in shortest.items():
        plants[name].close()
        rows.append((f"{name}: bare engine step", bare * 1e6, "us"))
        rows.append((f"{name}: plant, a physics step", driven * 1e6, "us"))
        rows.append((f"{name}: ratio", driven / bare, "1"))
    return rows


def times(plant: BulletPlant, steps: int = STEPS) -> tuple[float, float]:
    """Return the wall time of a bare engine step and of a driven physics step, s."""
    substeps = steps * Rates().substeps

    def bare() -> None:
        for _ in range(substeps):
            plant.bare_step()

    def driven() -> None:
        for _ in range(steps):
            plant.step((0.8, 0.0), (0.0, 0.0))

    plant.reset(STRAIGHT_CORRIDOR, np.random.default_rng(0))
    driving = best(driven, 1)
    return best(bare, 1) / substeps, driving / substeps
