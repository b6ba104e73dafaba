"""What wheels in contact with a floor put on the measured force, beside linear tyre slip."""

from __future__ import annotations

import numpy as np

from cowalk.sim.basics.rates import Rates
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.env.env import STRAIGHT_CORRIDOR

SECONDS, SETTLE = 20, 8
OPTIONS = {
    "slip, rigid grip": ("slip", "rigid"),
    "wheels, rigid grip": ("wheels", "rigid"),
    "wheels, compliant grip": ("wheels", "compliant"),
}
COURSES = {"straight": (0.8, 0.0), "turning at 0.26 rad/s": (0.8, 0.26)}


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, value, unit): 5 N intended sideways, no gait, 12 s after settling."""
    rows = []
    for course, twist in COURSES.items():
        for option, (drive, grip) in OPTIONS.items():
            plant = BulletPlant(Rates(), drive={"kind": drive}, grip={"kind": grip})
            plant.reset(STRAIGHT_CORRIDOR, np.random.default_rng(0))
            states = [plant.step(twist, (0.0, 5.0)) for _ in range(20 * SECONDS)][20 * SETTLE :]
            plant.close()
            force = np.concatenate([state.wrench_on_base[:, :3] for state in states])
            ripple = force[:, :2] - force[:, :2].mean(axis=0)
            name = f"{course}, {option}"
            rows.append((f"{name}: ripple of the force", float(ripple.std()), "N"))
            rows.append((f"{name}: largest deviation", float(np.abs(ripple).max()), "N"))
            rows.append((f"{name}: mean of Fz", float(force[:, 2].mean()), "N"))
    return rows
