"""A whole closed-loop run beside the bare engine steps of the same world."""

from __future__ import annotations

import numpy as np

from cowalk.scenarios.loading import load
from cowalk.scenarios.runner import make_env, run
from cowalk.scenarios.schema import Component

from .timing import best

STEPS = 300
"""Control steps timed of each part."""


def measure(name: str = "puddle") -> list[tuple[str, float, str]]:
    """Return rows of (what, value, unit) of a scenario."""
    scenario = load(name)
    shorter = scenario.model_copy(update={"duration": STEPS * scenario.rates.period, "expect": {}})
    substeps = STEPS * scenario.rates.substeps
    unicycle = shorter.model_copy(update={"plant": Component(name="unicycle")})
    env = make_env(shorter)
    env.reset(seed=0)
    plant = env._plant

    def driven(steps: int = STEPS) -> None:
        plant.reset(scenario.world, np.random.default_rng(0))
        for _ in range(steps):
            plant.step((0.8, 0.0), (0.0, 0.0))

    def bare() -> float:
        # In motion: of a world at rest the engine's solver has nothing to do.
        driven(40)
        return best(lambda: [plant.bare_step() for _ in range(substeps)], 1)

    # Interleaved, so that a slow moment of the machine hits all of them.
    wall = {"bare": [], "plant": [], "run": [], "unicycle": []}
    for _ in range(5):
        wall["bare"].append(bare())
        wall["plant"].append(best(driven, 1))
        wall["run"].append(run(shorter).summary["wall_time_s"])
        wall["unicycle"].append(run(unicycle).summary["wall_time_s"])
    env.close()
    fastest = {name: min(times) for name, times in wall.items()}
    simulated = STEPS * scenario.rates.period
    return [
        ("bare engine step", fastest["bare"] / substeps * 1e6, "us"),
        ("plant, a physics step", fastest["plant"] / substeps * 1e6, "us"),
        ("whole run, a physics step", fastest["run"] / substeps * 1e6, "us"),
        ("ratio of the plant to bare engine steps", fastest["plant"] / fastest["bare"], "1"),
        ("ratio of a whole run to bare engine steps", fastest["run"] / fastest["bare"], "1"),
        ("whole run in PyBullet, times real time", simulated / fastest["run"], "1"),
        ("whole run on the unicycle, times real time", simulated / fastest["unicycle"], "1"),
    ]
