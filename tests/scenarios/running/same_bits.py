"""Run scenarios in every way there is, and print what their traces are, bit for bit, as JSON.

``python same_bits.py WAY...``: once, again, reversed, threads, kept, filmed, fork, spawn.
"""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from cowalk.scenarios import load, run
from cowalk.scenarios.export.run_folder import RunFolder

BULLET = ("duration=1.5", "expect={}")
CASES = [
    ("puddle", *BULLET),
    ("puddle", "seed=2", "sensor=industrial", *BULLET),
    ("puddle", "automation=stubbornness", "seed=5", *BULLET),
    ("doorway", *BULLET),
    ("carry", *BULLET),
    ("walk", "human.imperfections=[{name: tremor}, {name: signal-dependent-noise}]", *BULLET),
    ("puddle", "plant=unicycle", "human=bounded-memory", "duration=5", "expect={}"),
    ("puddle", "plant=unicycle", "human.imperfections=[{name: gait-ripple}]", "expect={}"),
    ("paper-open-loop", "duration=5", "expect={}"),
    ("walk", "plant=unicycle", "human=game", "seed=7", "duration=5", "expect={}"),
]
FILMED = (0, 3, 4, 6, 8)


def bits(number: int, *watchers: object) -> str:
    """Return the digest of a case's trace."""
    name, *overrides = CASES[number]
    result = run(load(name, overrides), watchers=watchers)
    assert result.error is None, result.error
    return hashlib.sha256(result.trace.values.tobytes()).hexdigest()


def filmed(number: int) -> str:
    """Return that of a run that is filmed."""
    from cowalk.scenarios.watch.video import Video

    with tempfile.TemporaryDirectory() as folder:
        found = bits(number, Video(Path(folder, "run.mp4")))
        assert Path(folder, "run.mp4").stat().st_size > 1000
    return found


def kept(number: int) -> str:
    """Return that of a run that is written while it goes on."""
    with tempfile.TemporaryDirectory() as folder, RunFolder(Path(folder, "run")) as place:
        return bits(number, place)


def way(name: str) -> dict[int, str]:
    """Return digests by the number of their case, run in one of the ways."""
    numbers = range(len(CASES))
    if name in ("fork", "spawn"):
        with multiprocessing.get_context(name).Pool(2) as pool:
            return dict(zip(numbers, pool.map(bits, numbers, chunksize=1), strict=True))
    if name == "threads":
        with ThreadPoolExecutor(4) as pool:
            return dict(zip(numbers, pool.map(bits, numbers), strict=True))
    if name == "reversed":
        return {number: bits(number) for number in reversed(numbers)}
    if name == "filmed":
        return {number: filmed(number) for number in FILMED}
    if name == "kept":
        return {number: kept(number) for number in FILMED}
    return {number: bits(number) for number in numbers}


if __name__ == "__main__":
    print(json.dumps({name: way(name) for name in sys.argv[1:]}))
