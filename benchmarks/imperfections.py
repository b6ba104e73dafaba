"""What each imperfection adds to a control step of a steady human, alone and in a batch."""

from __future__ import annotations

import numpy as np

from cowalk.agents import HUMANS, IMPERFECTIONS

from .humans import BATCH, BATCH_STEPS, ROUNDS, STEPS, reference, scenes, walking
from .timing import best


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, value, unit)."""
    one, many = scenes(), scenes(BATCH, BATCH_STEPS)
    wrappers = {name: IMPERFECTIONS.get(name) for name in IMPERFECTIONS}
    build = HUMANS.get("steady")
    makers = {"": build} | {
        name: lambda wrap=wrap: wrap(build()) for name, wrap in wrappers.items()
    }
    alone, batched = dict.fromkeys(makers, np.inf), dict.fromkeys(makers, np.inf)
    subtraction = np.inf
    for _ in range(ROUNDS):
        subtraction = min(subtraction, best(reference, 1) / STEPS)
        for name, make in makers.items():
            alone[name] = min(alone[name], best(walking(make(), one), 1) / STEPS)
            cost = best(walking(make(), many), 1) / (BATCH_STEPS * BATCH)
            batched[name] = min(batched[name], cost)
    rows = []
    for name in wrappers:
        added = alone[name] - alone[""]
        rows.append((f"{name} adds to a step", added * 1e6, "us"))
        rows.append((f"{name} adds to a step, in subtractions", added / subtraction, "1"))
        cheaper = alone[name] / batched[name]
        rows.append((f"steady with {name}, times cheaper in a batch", cheaper, "1"))
    return rows
