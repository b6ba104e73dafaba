"""What a control step of each human model costs, alone and in a batch.

The scene is that of the shipped closed loop: a walk past a puddle, wish and twist changing.
Each further obstacle in sight costs more, above all in a batch; three are measured for one
model. A subtraction of two arrays of 2 numbers, timed in the same moments, stands for the machine.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from cowalk.agents import HUMANS, Human
from cowalk.sim import Observation, Situation
from cowalk.sim.basics.motion import TwistBounds, world_to_base
from cowalk.sim.basics.path import Path as WalkingPath

from .timing import best

SITUATION = Situation(WalkingPath(((0.0, 0.0), (30.0, 0.0))), 0.8, TwistBounds(), 0.05)
STEPS, BATCH_STEPS = 100, 10
BATCH = 10_000
PUDDLES = ((4.0, -0.7, 0.35), (7.0, 0.5, 0.3), (9.0, -0.2, 0.3))
"""x, y and radius, m."""
STEP, CHEAPER = ("at most", 30.0), ("at least", 100.0)
"""What a control step may cost, us, and how many times less a human of a batch costs."""
FREE = ("game",)
"""Models that may cost more, and say what they cost."""
ROUNDS = 12
"""Many short ones: other work on the machine misses some of them."""


def _recording(folder: str) -> str:
    time = np.arange(2000) * 0.002
    file = Path(folder) / "recording.npz"
    np.savez(file, t_s=time, fx_n=np.sin(time), fy_n=np.cos(time))
    return str(file)


def scenes(lanes: int | None = None, steps: int = STEPS, puddles: int = 1) -> list[Observation]:
    """Return what one human, or so many, perceive on a walk past puddles, a control step each."""
    count = 1 if lanes is None else lanes
    lane, period = np.arange(count), SITUATION.period
    x, y, theta = np.ones(count), np.linspace(-1.0, 1.0, count), np.zeros(count)
    felt = {"force": (12, 2), "wrench": (12, 6)}
    shared = {name: np.zeros((count, *shape)) for name, shape in felt.items()}
    seen = []
    for step in range(steps):
        v = 0.7 + 0.1 * np.sin(0.1 * step + lane)
        omega = 0.1 * np.sin(0.05 * step + 0.3 * lane)
        x = x + period * v * np.cos(theta)
        y = y + period * v * np.sin(theta)
        theta = theta + period * omega
        pose = np.stack((x, y, theta), axis=-1)
        obstacles = np.zeros((count, 8, 6))
        for row, (at_x, at_y, radius) in enumerate(PUDDLES[:puddles]):
            obstacles[:, row, 0], obstacles[:, row, 3] = 1.0, radius
            obstacles[:, row, 1:3] = world_to_base(pose, np.array([at_x, at_y]))
        all_of_it = {
            "twist": np.stack((v, omega), axis=-1),
            "pose": pose,
            "pose_world": pose.copy(),
            "obstacles": obstacles,
            "force_valid": np.ones((count, 12)),
            "time": np.full((count, 1), step * period),
            **shared,
        }
        own = {name: value[0] if lanes is None else value for name, value in all_of_it.items()}
        seen.append(Observation(**own))  # type: ignore[typeddict-item]
    return seen


def walking(human: Human, seen: list[Observation]) -> Callable[[], None]:
    """Return a function that takes a human on a walk."""

    def walk() -> None:
        human.reset(np.random.default_rng(0), SITUATION)
        for observation in seen:
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
    one, many = scenes(), scenes(BATCH, BATCH_STEPS)
    alone: dict[str, float] = {}
    batched: dict[str, float] = {}
    subtraction = np.inf
    with tempfile.TemporaryDirectory() as folder:
        needed = {"recorded": {"file": _recording(folder)}}
        humans = {name: HUMANS.get(name)(**needed.get(name, {})) for name in HUMANS}
        for _ in range(ROUNDS):
            subtraction = min(subtraction, best(reference, 1) / STEPS)
            for name, human in humans.items():
                cost = best(walking(human, one), 1) / STEPS
                alone[name] = min(alone.get(name, np.inf), cost)
                if getattr(human, "broadcasts", True):
                    cost = best(walking(human, many), 1) / (BATCH_STEPS * BATCH)
                    batched[name] = min(batched.get(name, np.inf), cost)
        three = best(walking(humans["steady"], scenes(puddles=3))) / STEPS
        crowd = best(walking(humans["steady"], scenes(BATCH, BATCH_STEPS, puddles=3)))
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
    per_human = crowd / (BATCH_STEPS * BATCH)
    rows.append(("steady past three puddles, a step", three * 1e6, "us", None))
    rows.append(
        ("steady past three puddles, a step in a batch", per_human * 1e6, "us a human", None)
    )
    return rows
