"""From a scenario to a finished run: build, step, record, judge."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from traceback import format_exception
from typing import Any

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.basics.errors import InputError, PartError, SimulationError, told
from cowalk.sim.env.env import CowalkEnv

from ..export.json_ready import json_ready
from ..files.schema import Scenario
from ..result import RunResult
from ..trace.recorder import Recorder
from ..trace.rewards import RewardSum
from ..trace.samples import SampleTable
from ..trace.sensor_faults import SampleCount
from ..watch.watcher import Watcher, Watchers
from .agent_output import require_belief, require_force, require_truth, require_twist
from .blame import Blame, Culprit
from .build import build_agents, make_env, seeds_of, situation_of
from .measured import measured
from .outcome import Attempt, outcome
from .outlines import collision, outlines
from .signals import SIGNALS, Hold, interrupts
from .step_limit import StepLimit, StepTooLong

Progress = Callable[[int, int], None]
"""Called with the control steps done and their total."""


def run(
    scenario: Scenario,
    progress: Progress | None = None,
    watchers: Sequence[Watcher] = (),
    window: bool = False,
    samples: bool = False,
    step_timeout: float | None = None,
) -> RunResult:
    """Run a scenario to its end.

    An agent or a body that goes astray ends the run cleanly: the result then carries
    ``error`` and the trace so far. So does an interrupt; another one waits until the result is
    made. A watcher that fails is left out, and said in `RunResult.lost`.

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
    step_timeout : float, optional
        End the run if a control step takes longer, s of the clock on the wall: a part may never
        return. Not on Windows, and in the main thread alone.

    Raises
    ------
    InputError
        If the scenario cannot be built, or a watcher cannot write what it is asked to.
    """
    SIGNALS.check()
    limit, watching = StepLimit(step_timeout), Watchers(watchers)
    human, automation = build_agents(scenario)
    env = make_env(scenario, "human" if window else None)
    with Hold() as hold:
        try:
            episode = _Episode(scenario, env, human, automation, progress, watching, samples)
            started = time.perf_counter()
            end, error = episode.end(limit, hold)
            attempt = Attempt(episode.fault)
            touched = attempt(lambda: collision(env) if end == "collision" else None, None)
            trace = episode.recorder.trace
            unmeasured: dict[str, Any] = {}
            found = attempt(lambda: measured(scenario, trace, env), unmeasured)
        finally:
            watching.close()
            env.close()
        wall_time = time.perf_counter() - started
        result = outcome(scenario, trace, end, error, wall_time, found, attempt)
        counted = {"sensor": episode.count.summary(), "reward": episode.earned.summary()}
        person = json_ready(episode.recorder.person)
        result.summary |= {"contact": touched, "person": person, **counted}
        result.samples, result.lost = episode.samples, watching.lost
        if len(result.trace):
            result.outlines = attempt(lambda: outlines(env), result.outlines)
        result.fault = attempt.fault
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
        watchers: Watchers,
        samples: bool,
    ) -> None:
        self._scenario, self._env = scenario, env
        self._human, self._automation = human, automation
        self._progress, self._watchers = progress, watchers
        self._acting = "plant"
        self.recorder = _recorder(scenario, env, human, automation)
        self.fault: str | None = None
        self.count, self.earned = SampleCount(), RewardSum()
        self.samples = SampleTable(scenario.rates) if samples else None
        self._infos: dict[str, dict[str, Any]] = {}

    def end(self, limit: StepLimit, hold: Hold) -> tuple[str, str | None]:
        """Step until the end; return how it ended, and the error if that is why."""
        try:
            with limit.heeded():
                self._walk(limit)
            hold.begin()  # within, so that no signal comes in between
        except BaseException as failure:  # a user's class may raise anything
            hold.begin()
            hold.ended = interrupts(failure)
            return self._ended_by(failure)
        last = self._infos["human"]
        reasons = [why for why in ("goal", "collision") if last[why]]
        return (*reasons, self._env.plant_state.end or "time")[0], None

    def _ended_by(self, failure: BaseException) -> tuple[str, str]:
        """Return how a run ends that something has ended, and why; what nobody has walked yet."""
        scenario = self._scenario
        if interrupts(failure):
            return "interrupted", f"{scenario.name}: interrupted by the user"
        culprit = Blame(scenario, self._human, self._automation).of(failure, self._usual())
        if isinstance(failure, InputError) and not len(self.recorder.trace):
            if culprit.shipped or self._acting == "watcher":
                raise failure
            raise InputError(f"{culprit.name}: {failure}", failure.at) from failure
        if isinstance(failure, SimulationError) and culprit.part is self._env.plant:
            return "aborted", f"{scenario.name}: {failure}"
        if culprit.at_fault(failure):
            self.fault = "".join(format_exception(failure))
        when = f"t = {len(self.recorder.trace) * scenario.rates.period:g} s"
        if isinstance(failure, PartError | StepTooLong):
            return "aborted", f"{culprit.name} at {when}: {failure}"
        return "aborted", f"{culprit.name} failed at {when}: {told(failure)}"

    def _usual(self) -> Culprit:
        """Return whom to blame where a failure shows nobody: who was to act."""
        scenario = self._scenario
        if self._acting == "human":
            return Culprit(f"human {scenario.human.name!r}", self._human)
        if self._acting == "automation":
            return Culprit(f"automation {scenario.automation.name!r}", self._automation)
        if self._acting == "watcher":
            return Culprit("who watches", None)
        return Culprit(f"plant {scenario.plant.name!r}", self._env.plant)

    def _walk(self, limit: StepLimit) -> None:
        """Step the environment until the episode is over; note who acts, for who fails."""
        scenario, env, human, automation = (
            self._scenario,
            self._env,
            self._human,
            self._automation,
        )
        trace, count, record = self.recorder.trace, self.count, self.recorder.step
        columns = self.recorder.added
        report_every = scenario.rates.control
        seeds = seeds_of(scenario)
        limit.start()
        self._acting = "plant"
        observations, self._infos = env.reset(seed=seeds.env)
        situation = situation_of(scenario, env)
        self._acting = "human"
        human.reset(seeds.human, situation)
        self._acting = "automation"
        automation.reset(seeds.automation, situation)
        limit.stop()
        self._acting = "watcher"
        self._watchers.start(scenario, env)
        while env.agents:
            SIGNALS.check()  # for one that a part has swallowed
            limit.start()
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
            limit.stop()
            self._acting = "watcher"
            self._watchers.step(env, trace)
            if self._progress is not None and len(trace) % report_every == 0:
                self._progress(len(trace), env.steps_per_episode)


def _recorder(scenario: Scenario, env: CowalkEnv, human: Human, automation: Automation) -> Recorder:
    """Return what keeps the trace; a user's automation may fail to name its columns."""
    try:
        return Recorder(env, human, automation)
    except InputError:
        raise
    except Exception as failure:
        who = f"automation {scenario.automation.name!r}"
        raise InputError(f"{who} failed to name its columns: {told(failure)}") from failure
