"""Many environments in one process: what each costs, and whether any leaves something behind."""

from __future__ import annotations

import gc
import os
from pathlib import Path

import numpy as np

from cowalk.scenarios.loading import load
from cowalk.scenarios.runner import make_env
from cowalk.sim.bullet import BulletPlant
from cowalk.sim.bullet_engine import connect, disconnect
from cowalk.sim.drive import DRIVES, DriveParameters
from cowalk.sim.env import STRAIGHT_CORRIDOR
from cowalk.sim.plant import Rates

from .timing import best

COUNTS = (1, 4, 16)
STEPS = 320
"""Control steps in all, shared by the environments of a count."""
CYCLES = 1000
"""Plants that are made and closed, of each drive."""


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, value, unit)."""
    return [*_stepping(), *_coming_and_going()]


def _stepping() -> list[tuple[str, float, str]]:
    envs = [make_env(load("walk")) for _ in range(max(COUNTS))]
    actions = {"human": np.zeros(2), "automation": np.array([0.8, 0.0])}
    shortest = dict.fromkeys(COUNTS, np.inf)
    for _ in range(5):
        for count in COUNTS:
            for env in envs[:count]:
                env.reset(seed=0)

            def turns(count: int = count) -> None:
                for _ in range(STEPS // count):
                    for env in envs[:count]:
                        env.step(actions)

            shortest[count] = min(shortest[count], best(turns, 1))
    for env in envs:
        env.close()
    return [
        (f"{count} environments: an environment step", time / STEPS * 1e6, "us")
        for count, time in shortest.items()
    ]


def _coming_and_going() -> list[tuple[str, float, str]]:
    def memory() -> float:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE")

    def next_client() -> int:
        client = connect()
        disconnect(client)
        return client

    rows = []
    for drive in DRIVES:

        def cycle(drive: str = drive) -> None:
            plant = BulletPlant(Rates(), drive=DriveParameters(kind=drive))
            plant.reset(STRAIGHT_CORRIDOR, np.random.default_rng(0))
            plant.step((0.8, 0.0), (0.0, 0.0))
            plant.save()
            plant.close()

        for _ in range(50):
            cycle()
        gc.collect()
        client, before = next_client(), memory()
        for _ in range(CYCLES):
            cycle()
        gc.collect()
        what = f"left by {CYCLES} create-close cycles, {drive}"
        rows.append((f"memory {what}", (memory() - before) / 1e6, "MB"))
        rows.append((f"clients {what}", float(next_client() - client), "1"))
    return rows
