"""From a scenario to a finished run: build, step, record, judge."""

from __future__ import annotations

import math
import platform
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import cache
from importlib.metadata import version
from typing import Any

import numpy as np

from cowalk.agents.basics.protocols import Automation, Belief, Human, Truth
from cowalk.agents.basics.steering import mirrored, mirrored_observation
from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.situation import Situation
from cowalk.sim.env.env import CowalkEnv

from ..expect.verdict import judge
from ..export.json_ready import json_ready
from ..export.run_folder import picture
from ..files.assembling import named_parts
from ..files.schema import Scenario
from ..trace.metrics import metrics
from ..trace.result import RunResult
from ..trace.sensor_faults import SampleCount
from ..trace.trace import Trace
from ..watch.watcher import Watcher, close_all
from .agent_output import AgentError, of_kind, pair
from .build import build_agents, make_env
from .outlines import collision, extent, outlines

_VERSIONED = ("numpy", "scipy", "pybullet", "pettingzoo", "filterpy")

Progress = Callable[[int, int], None]
"""Called with the control steps done and their total."""


def run(
    scenario: Scenario,
    progress: Progress | None = None,
    watchers: Sequence[Watcher] = (),
    window: bool = False,
) -> RunResult:
    """Run a scenario to its end.

    An agent or a body that goes astray ends the run cleanly: the result then carries
    ``error`` and the trace so far.

    Parameters
    ----------
    scenario : Scenario
    progress : callable, optional
    watchers : sequence of Watcher
        Told of every control step; they are closed however the run ends.
    window : bool
        Show the run in a window, on the PyBullet plant at no more than real time.

    Raises
    ------
    InputError
        If the scenario cannot be built, or a watcher cannot write what it is asked to.
    """
    human, automation = build_agents(scenario)
    env = make_env(scenario, "human" if window else None)
    trace, count = Trace(), SampleCount()
    started = time.perf_counter()
    try:
        end, error = _episode(scenario, env, human, automation, trace, count, progress, watchers)
        touched = collision(env) if end == "collision" else None
    finally:
        lost = close_all(watchers)
        env.close()
    if lost is not None and error is None:
        end, error = "aborted", f"{scenario.name}: {lost}"
    wall_time = time.perf_counter() - started
    result = _result(scenario, trace, end, error, wall_time)
    result.summary |= {"contact": touched, "sensor": count.summary()}
    if len(trace):
        result.outlines = outlines(env)
    return result


def _episode(
    scenario: Scenario,
    env: CowalkEnv,
    human: Human,
    automation: Automation,
    trace: Trace,
    count: SampleCount,
    progress: Progress | None,
    watchers: Sequence[Watcher],
) -> tuple[str, str | None]:
    """Step until the end; return how it ended, and the error if that is why."""
    env_seed, human_seed, automation_seed = np.random.SeedSequence(scenario.seed).spawn(3)
    names = {
        "human": f"human {scenario.human.name!r}",
        "automation": f"automation {scenario.automation.name!r}",
        "plant": f"plant {scenario.plant.name!r}",
        "watcher": " or ".join(f"watcher {type(watcher).__name__!r}" for watcher in watchers),
    }
    total = env.steps_per_episode
    report_every = 1 if watchers else scenario.rates.control
    infos: dict[str, dict[str, Any]] = {}
    behind = env.plant.steers_from_behind
    actor = "plant"
    try:
        observations, infos = env.reset(seed=int(env_seed.generate_state(1)[0]))
        situation = Situation(
            scenario.world.path,
            scenario.pace,
            scenario.bounds,
            scenario.rates.period,
            extent(env),
        )
        actor = "human"
        human.reset(np.random.default_rng(human_seed), situation)
        actor = "automation"
        automation.reset(np.random.default_rng(automation_seed), situation)
        actor = "watcher"
        for watcher in watchers:
            watcher.start(scenario, env)
        while env.agents:
            if behind:
                observations = {s: mirrored_observation(o) for s, o in observations.items()}
            actor = "human"
            force = human.act(observations["human"])
            pair(force, "act", "the force [fx, fy] in N")
            if behind:
                force = mirrored(force)
            truth = _of_truth(human.truth())
            actor = "automation"
            twist = automation.act(observations["automation"])
            pair(twist, "act", "the twist [v, omega] in m/s and rad/s")
            belief = _of_belief(automation.belief())
            actor = "plant"
            observations, _, _, _, infos = env.step({"human": force, "automation": twist})
            count.add(env.sensor_reading)
            time_now = (len(trace) + 1) / scenario.rates.control
            trace.append(_row(time_now, env, truth, belief, infos["human"]["clearance"]))
            for watcher in watchers:
                actor = "watcher"
                watcher.step(env, trace)
            if progress is not None and len(trace) % report_every == 0:
                progress(len(trace), total)
    except InputError:
        raise
    except SimulationError as failure:
        return "aborted", f"{scenario.name}: {failure}"
    except KeyboardInterrupt:
        return "interrupted", f"{scenario.name}: interrupted by the user"
    except AgentError as failure:
        when = f"t = {len(trace) * scenario.rates.period:g} s"
        return "aborted", f"{names[actor]} at {when}: {failure}"
    except (Exception, SystemExit) as failure:  # a user's class may raise anything
        when = f"t = {len(trace) * scenario.rates.period:g} s"
        return "aborted", f"{names[actor]} failed at {when}: {type(failure).__name__}: {failure}"
    last = infos["human"]
    reasons = [why for why in ("goal", "collision") if last[why]]
    if last["grip_lost"] and env.plant_state.over:
        reasons.append("grip lost")
    return (reasons or ["time"])[0], None


def _of_truth(truth: Truth) -> tuple[float, ...]:
    of_kind(truth, Truth, "truth")
    return (
        *pair(truth.stubbornness, "truth", "the stubbornness [v, omega]"),
        *pair(truth.wish, "truth", "the wish [v, omega] in m/s and rad/s"),
    )


def _of_belief(belief: Belief) -> tuple[float, ...]:
    of_kind(belief, Belief, "belief")
    return (
        *belief.stubbornness.tolist(),
        *belief.stubbornness_smoothed.tolist(),
        *belief.human_wish.tolist(),
        *belief.wish.tolist(),
        float(belief.interaction),
        float(belief.interaction_smoothed),
        float(belief.utility_loss),
        float(belief.target_utility),
        float(belief.negotiation),
    )


def _row(
    time_now: float,
    env: CowalkEnv,
    truth: tuple[float, ...],
    belief: tuple[float, ...],
    clearance: float,
) -> tuple[float, ...]:
    """Return a trace row, in the order of `cowalk.scenarios.trace.trace.UNITS`."""
    state, reading = env.plant_state, env.sensor_reading
    force, twist = env.applied
    samples = len(reading.wrench)
    return (
        time_now,
        *state.pose,
        *state.twist,
        *twist,
        *(reading.force.sum(axis=0) / samples).tolist(),
        *(reading.wrench.sum(axis=0) / samples).tolist(),
        *force,
        *state.human_pose,
        *truth,
        *belief,
        clearance,
    )


@cache
def _versions() -> dict[str, str]:
    """Return the versions of what a result depends on: read from files, so only once."""
    return {name: version(name) for name in ("cowalk", *_VERSIONED)}


def _result(
    scenario: Scenario, trace: Trace, end: str, error: str | None, wall_time: float
) -> RunResult:
    """Score and judge what was recorded."""
    period = scenario.rates.period
    columns = trace.columns()
    verdicts = judge(scenario.expect, columns, period) if len(trace) else []
    simulated = len(trace) * period
    summary = {
        "scenario": scenario.name,
        **named_parts(scenario),
        "seed": scenario.seed,
        "end": end,
        "error": error,
        "simulated_time_s": simulated,
        "wall_time_s": wall_time,
        "real_time_factor": simulated / wall_time if wall_time > 0.0 else math.inf,
        "metrics": metrics(columns, period, scenario.world.path) if len(trace) else {},
        "expectations": [asdict(verdict) for verdict in verdicts],
        "versions": {"python": platform.python_version(), **_versions()},
    }
    return RunResult(scenario, trace, json_ready(summary), verdicts, error, picture=picture)
