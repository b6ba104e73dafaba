"""Many environments in one process: what each costs, and whether any leaves something behind."""

from __future__ import annotations

import gc
import os
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from cowalk.scenarios.files.loading import load
from cowalk.scenarios.running.build import make_env
from cowalk.sim.engine.engine import connect, disconnect
from cowalk.sim.env.env import CowalkEnv
from cowalk.sim.robot.drive import DRIVES

from .timing import best

COUNTS = (1, 4, 16)
STEPS = 320
"""Control steps in all, shared by the environments of a count."""
CYCLES = 1000
"""Environments that are made and closed, of each drive."""
TOGETHER = 10
"""Environments that are open at once to see what memory one takes."""


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, value, unit)."""
    # In a process of its own: here earlier ones may have left memory to use again.
    with ProcessPoolExecutor(1, get_context("spawn")) as apart:
        taken = apart.submit(_taken).result()
    return [*_stepping(), ("memory of an environment", taken / 1e6, "MB"), *_left()]


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


def _memory() -> float:
    """Return what this process takes, bytes."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return float(pages * os.sysconf("SC_PAGE_SIZE"))


def _taken() -> float:
    """Return what an environment takes, beside what all of them share, bytes."""
    world = load("doorway").world
    CowalkEnv(world).close()
    before = _memory()
    envs = [CowalkEnv(world) for _ in range(TOGETHER)]
    taken = (_memory() - before) / TOGETHER
    for env in envs:
        env.close()
    return taken


def _left() -> list[tuple[str, float, str]]:
    def next_client() -> int:
        client = connect()
        disconnect(client)
        return client

    world, rows = load("doorway").world, []
    for drive in DRIVES:

        def cycle(drive: str = drive) -> None:
            env = CowalkEnv(world, plant_parameters={"drive": {"kind": drive}})
            env.reset(seed=0)
            env.step({"human": np.zeros(2), "automation": np.array([0.8, 0.0])})
            env.save()
            env.close()

        for _ in range(50):
            cycle()
        gc.collect()
        client, before = next_client(), _memory()
        for _ in range(CYCLES):
            cycle()
        gc.collect()
        what = f"left by {CYCLES} create-close cycles, {drive}"
        rows.append((f"memory {what}", (_memory() - before) / 1e6, "MB"))
        rows.append((f"clients {what}", float(next_client() - client), "1"))
    return rows
