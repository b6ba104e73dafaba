"""A whole closed-loop run beside the bare engine steps of the same world."""

from __future__ import annotations

import numpy as np

from cowalk.scenarios.files.loading import load
from cowalk.scenarios.files.schema import Component
from cowalk.scenarios.running.build import make_env
from cowalk.scenarios.running.runner import run

from .timing import best

STEPS = 500
"""Control steps timed of each part: about as many as the shipped runs take."""
ROUNDS = 6


def measure(
    name: str = "puddle", real_time: float = 60.0, ratio: float = 3.0, drive: str = "slip"
) -> list[tuple[str, float, str, tuple[str, float] | None]]:
    """Return rows of (what, value, unit, target) of a scenario.

    Parameters
    ----------
    name : str
    real_time : float
        Times real time that a whole run should reach at least.
    ratio : float
        Ratio of a whole run to bare engine steps that it should have at most.
    drive : {"slip", "wheels"}
        With wheels the engine has contacts to solve: bare steps take longer, the rest does not.
    """
    scenario = load(name, [f"plant.parameters.drive.kind={drive}"])
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
        return best(coast, 1)

    def coast() -> None:
        for _ in range(substeps):
            plant.bare_step()

    def called() -> float:
        # What driving and measuring asks of the engine, without any law of ours.
        driven(40)
        pair = plant._pair
        base = pair.base.zeros if drive == "slip" else ()
        human = pair.human.zeros

        def calls() -> None:
            for _ in range(substeps):
                if base:
                    pair.base.apply(base)
                pair.human.apply(human)
                plant.bare_step()
                pair.base.read()
                pair.hands.read(1.0, 0.0)

        return best(calls, 1)

    # Interleaved, so that a slow moment of the machine hits all of them.
    wall = {"bare": [], "calls": [], "plant": [], "run": [], "unicycle": []}
    for _ in range(ROUNDS):
        wall["bare"].append(bare())
        wall["calls"].append(called())
        wall["plant"].append(best(driven, 1))
        wall["run"].append(run(shorter).summary["wall_time_s"])
        wall["unicycle"].append(run(unicycle).summary["wall_time_s"])
    env.close()
    fastest = {name: min(times) for name, times in wall.items()}
    simulated = STEPS * scenario.rates.period
    faster = simulated / fastest["run"]
    us, times = 1e6 / substeps, {part: t / fastest["bare"] for part, t in fastest.items()}
    return [
        ("bare engine step", fastest["bare"] * us, "us", None),
        ("engine calls of a driven step, no laws", fastest["calls"] * us, "us", None),
        ("plant, a physics step", fastest["plant"] * us, "us", None),
        ("whole run, a physics step", fastest["run"] * us, "us", None),
        ("ratio of engine calls to bare steps", times["calls"], "1", None),
        ("ratio of the plant to bare steps", times["plant"], "1", None),
        ("ratio of a whole run to bare steps", times["run"], "1", ("at most", ratio)),
        ("whole run in PyBullet, times real time", faster, "1", ("at least", real_time)),
        ("whole run on the unicycle, times real time", simulated / fastest["unicycle"], "1", None),
    ]
