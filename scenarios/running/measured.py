"""The metrics of a run, from its trace and from where its plant can measure distances."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from cowalk.sim.basics.motion import compose, world_to_base
from cowalk.sim.basics.situation import Situation
from cowalk.sim.env.env import CowalkEnv
from cowalk.sim.world.world import World

from ..files.schema import Scenario
from ..measures.disagreement import things_of
from ..measures.metrics import metrics
from ..trace.trace import Trace


def measured(scenario: Scenario, trace: Trace, env: CowalkEnv | None = None) -> dict[str, Any]:
    """Return value, unit and share of rows of every metric, by name.

    Parameters
    ----------
    scenario : Scenario
    trace : Trace
        Nothing is measured of one without rows.
    env : CowalkEnv, optional
        In which it was recorded; without it what only the plant knows is left out.
    """
    if not len(trace):
        return {}
    found: dict[str, Any] = metrics(
        trace.columns(),
        Situation(
            scenario.world.path,
            scenario.pace,
            scenario.bounds,
            scenario.rates.period,
            rates=scenario.rates,
        ),
        scenario.automation.negotiation,
        things_of(scenario.world),
        env.plant.steers_from_behind if env else None,
    )
    for thing, distance in (clearances(env, trace) if env else {}).items():
        found[f"clearance to {thing}"] = {"value": distance, "unit": "m", "share": 1.0}
    return found


def clearances(env: CowalkEnv, trace: Trace) -> dict[str, float]:
    """Return how near the pair came to each thing of the world, m, by the thing's key.

    Walls and doorways are left out: who walks in a corridor is always near them.

    Parameters
    ----------
    env : CowalkEnv
        In which it was recorded: from it is known where a load has its place.
    trace : Trace
    """
    world, state = env.world, env.plant_state
    empty = World(world.path, start=world.start)
    alone = {
        **{f"obstacles.{n}": replace(empty, obstacles=(o,)) for n, o in enumerate(world.obstacles)},
        **{f"furniture.{n}": replace(empty, furniture=(f,)) for n, f in enumerate(world.furniture)},
        **{
            f"pedestrians.{n}": replace(empty, pedestrians=(p,))
            for n, p in enumerate(world.pedestrians)
        },
    }
    base, human = (
        np.stack([trace[f"{body}{axis}"] for axis in ("x", "y", "theta")], axis=-1)
        for body in ("", "human_")
    )
    poses = [base, human]
    if state.load_pose is not None:  # it is clamped on, and keeps its place on the base
        x, y = world_to_base(state.pose, state.load_pose[:2]).tolist()
        poses.append(compose(base, (x, y, state.load_pose[2] - state.pose[2])))
    placed = (map(tuple, each.tolist()) for each in poses)
    steps = list(zip(trace["t"].tolist(), *placed, strict=True))
    found = {}
    for key, one in alone.items():
        measure = env.plant.distances(one)
        found[key] = min(measure(*step)[0] for step in steps)
        measure.close()
    return found
