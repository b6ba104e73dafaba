"""Timing that a busy machine disturbs least: the best of several repeats."""

from __future__ import annotations

import time
from collections.abc import Callable

REPEATS = 5


def best(action: Callable[[], object], repeats: int = REPEATS) -> float:
    """Return the shortest wall time of an action over repeats, s."""
    times = []
    for _ in range(repeats):
        started = time.perf_counter()
        action()
        times.append(time.perf_counter() - started)
    return min(times)
