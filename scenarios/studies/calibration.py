"""The search that finds the constants which the paper does not print."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from scipy.optimize import differential_evolution

from cowalk.agents.automations.planner.settings import NegotiationSettings
from cowalk.agents.automations.strategies.stubbornness import StubbornnessAutomation
from cowalk.agents.humans.open_loop import OpenLoopHuman
from cowalk.sim.basics.motion import Array, arc_displacement, compose
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation

from ..files.loading import load
from .paper import REPORTED, SCENARIO, Row, measure, rows

SEARCHED = {
    "omega_ub, rad/s": (0.15, 1.0),
    "horizon tau, s": (0.5, 4.0),
    "w3/w1, m^2 s^2/rad^2": (0.0, 0.5),
}
"""What is searched, and between which bounds; the other inferred constants stay fixed."""

_KEYS = {
    "omega_ub, rad/s": ("bounds.lower=[0.0, -{0:.6g}]", "bounds.upper=[1.2, {0:.6g}]"),
    "horizon tau, s": ("automation.negotiation.horizon={0:.6g}",),
    "w3/w1, m^2 s^2/rad^2": ("automation.negotiation.turn_weight={0:.6g}",),
}

GENERATIONS = 40
_POPULATION = 100
"""Lanes a constant. With 15, most seeds end among long horizons, where turn rates meet late."""


@dataclass(frozen=True)
class _BatchBounds:
    lower: Array
    upper: Array


def simulate(omega_bound: Array, horizon: Array, turn_weight: Array) -> dict[str, Array]:
    """Return what `measure` finds for a batch of constants, all simulated at once.

    The twist is constant between negotiations and arcs are exact, so the points of one arc a
    negotiation are the same path as the runner's control steps.

    Parameters
    ----------
    omega_bound, horizon, turn_weight : ndarray, shape (n,)
        rad/s, s, and w3 at w1 = 1.

    Returns
    -------
    dict of ndarray, shape (n,)
    """
    scenario = load(SCENARIO)
    base: NegotiationSettings = scenario.automation.negotiation
    lanes = len(omega_bound)
    speed = np.full(lanes, scenario.bounds.upper[0])
    bounds = _BatchBounds(
        np.stack((np.zeros(lanes), -omega_bound), axis=-1), np.stack((speed, omega_bound), axis=-1)
    )
    situation = Situation(scenario.world.path, scenario.pace, bounds, base.period)
    # The settings are annotated for one run; the planner takes a lane axis as well.
    settings = replace(
        base,
        horizon=cast(float, horizon),
        turn_weight=cast(float, turn_weight * base.distance_weight),
    )
    automation = StubbornnessAutomation(**scenario.automation.parameters, negotiation=settings)
    human = OpenLoopHuman(**scenario.human.parameters)
    generator = np.random.default_rng(0)
    automation.reset(generator, situation)
    human.reset(generator, situation)
    pose, twist = np.zeros((lanes, 3)), np.zeros((lanes, 2))
    time = np.arange(round(scenario.duration / base.period), dtype=float) * base.period
    # Once a control step, as the trace has the path, shape (steps, 1).
    since = scenario.rates.period * np.arange(1.0, base.steps(scenario.rates.period) + 1.0)[:, None]
    record: dict[str, list[Array]] = {
        key: [] for key in ("stubbornness", "target_utility", "omega", "wish", "y")
    }
    for now in time:
        observation = Observation(
            twist=twist,
            force=np.zeros((lanes, 1, 2)),
            wrench=np.zeros((lanes, 1, 6)),
            force_valid=np.ones((lanes, 1)),
            pose=scenario.world.path.relative_pose(pose),
            pose_world=pose,
            obstacles=np.zeros((lanes, 0, 6)),
            # The sensor reports the control step that ends now, decided a period ago.
            time=np.full((lanes, 1), now - scenario.rates.period),
        )
        force = human.act(observation)[:, None, :]
        observation["force"] = observation["wrench"][..., :2] = force
        twist = automation.act(observation)
        belief = automation.belief()
        record["stubbornness"].append(belief.stubbornness[:, 1])
        record["target_utility"].append(np.asarray(belief.target_utility))
        record["omega"].append(twist[:, 1])
        record["wish"].append(belief.wish[:, 1])
        on_arc = compose(pose, arc_displacement(twist, since))
        record["y"].extend(on_arc[..., 1])
        pose = on_arc[-1]
    stacked = {key: np.stack(values) for key, values in record.items()}
    return measure(time, **stacked, omega_bound=omega_bound)


def overrides(constants: Mapping[str, float]) -> list[str]:
    """Return the ``KEY=VALUE`` overrides that put found constants into the scenario."""
    return [template.format(value) for name, value in constants.items() for template in _KEYS[name]]


def deviation(measured: dict[str, Array]) -> Array:
    """Return how badly a set misses the reported numbers, shape (n,).

    Largest deviation in units of its tolerance, plus a tenth of the mean so that sets with the
    same worst row still differ.
    """
    off = np.stack(
        [
            np.abs(np.minimum(measured[key], 1e3) - reported.value) / reported.tolerance
            for key, reported in REPORTED.items()
        ]
    )
    return np.asarray(off.max(axis=0) + 0.1 * off.mean(axis=0))


def calibrate(
    seed: int = 0, progress: Callable[[int, int], None] | None = None
) -> tuple[dict[str, float], list[Row]]:
    """Search the constants by differential evolution.

    Parameters
    ----------
    seed : int
        Seed of the search.
    progress : callable, optional
        Called with the generations done and their total.

    Returns
    -------
    (dict, list of Row)
        The constants found, by the names of `SEARCHED`, and the rows they give.
    """
    done = 0

    def report(*_: Any, **__: Any) -> None:
        nonlocal done
        done += 1
        if progress is not None:
            progress(done, GENERATIONS)

    found = differential_evolution(
        lambda constants: deviation(simulate(*constants)),
        list(SEARCHED.values()),
        rng=seed,
        vectorized=True,
        updating="deferred",
        popsize=_POPULATION,
        maxiter=GENERATIONS,
        tol=0.0,
        polish=False,
        callback=report,
    )
    measured = simulate(*found.x[:, None])
    names = list(SEARCHED)
    return (
        {name: float(value) for name, value in zip(names, found.x, strict=True)},
        rows({key: value[0] for key, value in measured.items()}),
    )
