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

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.basics.errors import InputError, PartError, SimulationError
from cowalk.sim.env.env import CowalkEnv

from ..expect.verdict import judge
from ..export.json_ready import json_ready
from ..export.run_folder import picture
from ..files.assembling import named_parts
from ..files.schema import Scenario
from ..result import RunResult
from ..trace.metrics import metrics
from ..trace.recorder import Recorder
from ..trace.rewards import RewardSum
from ..trace.samples import SampleTable
from ..trace.sensor_faults import SampleCount
from ..trace.trace import FORMAT, Trace
from ..watch.watcher import Watcher, close_all
from .agent_output import require_belief, require_force, require_truth, require_twist
from .blame import Blame
from .build import build_agents, make_env, seeds_of, situation_of
from .outlines import collision, outlines

_VERSIONED = ("numpy", "scipy", "pybullet", "pettingzoo", "filterpy")

Progress = Callable[[int, int], None]
"""Called with the control steps done and their total."""


def run(
    scenario: Scenario,
    progress: Progress | None = None,
    watchers: Sequence[Watcher] = (),
    window: bool = False,
    samples: bool = False,
) -> RunResult:
    """Run a scenario to its end.

    An agent or a body that goes astray ends the run cleanly: the result then carries
    ``error`` and the trace so far.

    Parameters
    ----------
    scenario : Scenario
    progress : callable, optional
        Called with the control steps done and their total.
    watchers : sequence of Watcher
        Told of every control step; they are closed however the run ends.
    window : bool
        Show the run in a window, on the PyBullet plant at no more than real time.
    samples : bool
        Keep a row a force sample as well: `RunResult.samples`.

    Raises
    ------
    InputError
        If the scenario cannot be built, or a watcher cannot write what it is asked to.
    """
    human, automation = build_agents(scenario)
    env = make_env(scenario, "human" if window else None)
    episode = _Episode(scenario, env, human, automation, progress, watchers, samples)
    started = time.perf_counter()
    try:
        end, error = episode.end()
        touched = collision(env) if end == "collision" else None
    finally:
        lost = close_all(watchers)
        env.close()
    if lost is not None and error is None:
        end, error = "aborted", f"{scenario.name}: {lost}"
    wall_time = time.perf_counter() - started
    result = _result(scenario, episode.recorder.trace, end, error, wall_time)
    counted = {"sensor": episode.count.summary(), "reward": episode.earned.summary()}
    person = json_ready(episode.recorder.person)
    result.summary |= {"contact": touched, "person": person, **counted}
    result.samples = episode.samples
    if len(result.trace):
        result.outlines = outlines(env)
    return result


class _Episode:
    """One run while it goes on: the loop, and what it keeps."""

    def __init__(
        self,
        scenario: Scenario,
        env: CowalkEnv,
        human: Human,
        automation: Automation,
        progress: Progress | None,
        watchers: Sequence[Watcher],
        samples: bool,
    ) -> None:
        self._scenario, self._env = scenario, env
        self._human, self._automation = human, automation
        self._progress, self._watchers = progress, watchers
        self.recorder = Recorder(env, human, automation)
        self.count, self.earned = SampleCount(), RewardSum()
        self.samples = SampleTable(scenario.rates) if samples else None
        self._infos: dict[str, dict[str, Any]] = {}

    def end(self) -> tuple[str, str | None]:
        """Step until the end; return how it ended, and the error if that is why."""
        scenario = self._scenario
        try:
            self._walk()
        except InputError as failure:
            if not len(self.recorder.trace):
                raise
            return "aborted", self._blamed(failure)
        except SimulationError as failure:
            return "aborted", f"{scenario.name}: {failure}"
        except KeyboardInterrupt:
            return "interrupted", f"{scenario.name}: interrupted by the user"
        except BaseException as failure:  # a user's class may raise anything
            return "aborted", self._blamed(failure)
        last = self._infos["human"]
        reasons = [why for why in ("goal", "collision") if last[why]]
        if last["grip_lost"] and self._env.plant_state.over:
            reasons.append("grip lost")
        return (reasons or ["time"])[0], None

    def _walk(self) -> None:
        """Step the environment until the episode is over; note who acts, for who fails."""
        scenario, env, human, automation = (
            self._scenario,
            self._env,
            self._human,
            self._automation,
        )
        trace, count, record = self.recorder.trace, self.count, self.recorder.step
        columns = self.recorder.added
        report_every = 1 if self._watchers else scenario.rates.control
        seeds = seeds_of(scenario)
        self._acting = "plant"
        observations, self._infos = env.reset(seed=seeds.env)
        situation = situation_of(scenario, env)
        self._acting = "human"
        human.reset(seeds.human, situation)
        self._acting = "automation"
        automation.reset(seeds.automation, situation)
        self._acting = "watcher"
        for watcher in self._watchers:
            watcher.start(scenario, env)
        while env.agents:
            self._acting = "human"
            force = human.act(observations["human"])
            require_force(human, force)
            truth = human.truth()
            require_truth(human, truth, env.bounds)
            self._acting = "automation"
            twist = automation.act(observations["automation"])
            require_twist(automation, twist)
            belief = automation.belief()
            require_belief(automation, belief, columns)
            self._acting = "plant"
            actions = {"human": force, "automation": twist}
            observations, rewards, _, _, self._infos = env.step(actions)
            count.add(env.sensor_reading)
            self.earned.add(env.reward_terms)
            if self.samples is not None:
                self.samples.add(env)
            record(rewards, self._infos, truth, belief)
            self._acting = "watcher"
            for watcher in self._watchers:
                watcher.step(env, trace)
            if self._progress is not None and len(trace) % report_every == 0:
                self._progress(len(trace), env.steps_per_episode)

    def _blamed(self, failure: BaseException) -> str:
        """Return who failed when, and how, in one line."""
        scenario = self._scenario
        seats = {
            "human": f"human {scenario.human.name!r}",
            "automation": f"automation {scenario.automation.name!r}",
            "plant": f"plant {scenario.plant.name!r}",
            "watcher": " or ".join(f"watcher {type(each).__name__!r}" for each in self._watchers),
        }
        blame = Blame(scenario, self._human, self._automation)
        name = blame.of(failure, seats[self._acting])
        when = f"t = {len(self.recorder.trace) * scenario.rates.period:g} s"
        if isinstance(failure, PartError):
            return f"{name} at {when}: {failure}"
        return f"{name} failed at {when}: {type(failure).__name__}: {failure}"


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
        "format": FORMAT,
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
