"""What a control step of each human model costs, alone and in a batch.

The scene is the shipped closed loop's: walking, one puddle in sight. A subtraction of two
arrays of 2 numbers, timed in the same moments, stands for the machine.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from cowalk.agents import HUMANS, Human, Observation, Situation
from cowalk.sim.motion import TwistBounds
from cowalk.sim.path import Path as WalkingPath

from .timing import best

SITUATION = Situation(WalkingPath(((0.0, 0.0), (30.0, 0.0))), 0.8, TwistBounds(), 0.05)
STEPS = 50
BATCH = 10_000
STEP, CHEAPER = ("at most", 30.0), ("at least", 100.0)
"""What a control step may cost, us, and how many times less a human of a batch costs."""
FREE = ("game",)
"""Models that may cost more, and say what they cost."""
ROUNDS = 60
"""Many short ones: other work on the machine misses some of them."""


def _recording(folder: str) -> str:
    time = np.arange(2000) * 0.002
    file = Path(folder) / "recording.npz"
    np.savez(file, t_s=time, fx_n=np.sin(time), fy_n=np.cos(time))
    return str(file)


def scene(lanes: int | None = None) -> Observation:
    """Return the scene for one human, or for as many."""
    obstacles = np.zeros((8, 4))
    obstacles[0] = [1.0, 3.0, -0.7, 0.35]
    one = Observation(
        twist=np.array([0.7, 0.1]),
        force=np.zeros((12, 2)),
        wrench=np.zeros((12, 6)),
        force_valid=np.ones(12),
        pose=np.array([1.0, 0.1, 0.05]),
        pose_world=np.array([1.0, 0.1, 0.05]),
        obstacles=obstacles,
        time=np.array([1.0]),
    )
    if lanes is None:
        return one
    batch = {key: np.repeat(value[None], lanes, axis=0) for key, value in one.items()}
    for pose in ("pose", "pose_world"):
        batch[pose][:, 1] = np.linspace(-1.0, 1.0, lanes)
    return Observation(**batch)


def walking(human: Human, observation: Observation, steps: int) -> Callable[[], None]:
    """Return a function that steps a human in a scene."""
    human.reset(np.random.default_rng(0), SITUATION)

    def walk() -> None:
        for _ in range(steps):
            human.act(observation)
            human.truth()

    return walk


def reference() -> None:
    """Subtract `STEPS` times."""
    a, b = np.array([0.7, 0.1]), np.array([1.2, 0.5])
    for _ in range(STEPS):
        a - b


def measure() -> list[tuple[str, float, str, tuple[str, float] | None]]:
    """Return rows of (what, value, unit, target)."""
    one, many = scene(), scene(BATCH)
    alone: dict[str, float] = {}
    batched: dict[str, float] = {}
    subtraction = np.inf
    with tempfile.TemporaryDirectory() as folder:
        needed = {"recorded": {"file": _recording(folder)}}
        humans = {name: HUMANS.get(name)(**needed.get(name, {})) for name in HUMANS}
        for _ in range(ROUNDS):
            subtraction = min(subtraction, best(reference, 1) / STEPS)
            for name, human in humans.items():
                cost = best(walking(human, one, STEPS), 1) / STEPS
                alone[name] = min(alone.get(name, np.inf), cost)
                if getattr(human, "broadcasts", True):
                    cost = best(walking(human, many, 1), 1) / BATCH
                    batched[name] = min(batched.get(name, np.inf), cost)
    rows: list[tuple[str, float, str, tuple[str, float] | None]] = []
    rows.append(("subtraction of two pairs", subtraction * 1e6, "us", None))
    for name, cost in alone.items():
        rows.append((f"{name}, a step", cost * 1e6, "us", None if name in FREE else STEP))
        rows.append((f"{name}, a step in subtractions", cost / subtraction, "1", None))
        if name in batched:
            rows.append((f"{name}, a step in a batch", batched[name] * 1e6, "us a human", None))
            rows.append((f"{name}, times cheaper in a batch", cost / batched[name], "1", CHEAPER))
        else:
            rows.append((f"{name} cannot be a batch", np.nan, "", None))
    return rows
