"""A loop of one's own over the PettingZoo environment is the run, bit for bit."""

from typing import ClassVar

import numpy as np
import pytest
from pyarrow import parquet

from cowalk.agents.automations.strategies.never_yields import NeverYields
from cowalk.estimation import PaperObserver
from cowalk.scenarios import (
    Recorder,
    build_agents,
    load,
    make_env,
    run,
    scenario_library,
    seeds_of,
    situation_of,
)
from cowalk.scenarios.files import validation
from cowalk.scenarios.trace import trace as trace_module
from cowalk.scenarios.trace.trace import Trace
from cowalk.sim import InputError


def walked(scenario):
    """Step a scenario's agents by hand, as anybody would who knows PettingZoo."""
    env = make_env(scenario)
    human, automation = build_agents(scenario)
    recorder = Recorder(env, human, automation)
    seeds = seeds_of(scenario)
    observations, _ = env.reset(seed=seeds.env)
    situation = situation_of(scenario, env)
    human.reset(seeds.human, situation)
    automation.reset(seeds.automation, situation)
    while env.agents:
        actions = {
            "human": human.act(observations["human"]),
            "automation": automation.act(observations["automation"]),
        }
        observations, rewards, _, _, infos = env.step(actions)
        recorder.step(rewards, infos)
    env.close()
    return recorder.trace


@pytest.mark.parametrize("name", scenario_library())
def test_a_hand_written_loop_gives_the_trace_of_run(name):
    scenario = load(name)
    found, expected = walked(scenario), run(scenario).trace
    assert found.units == expected.units
    assert len(found) > 100
    assert found.values.tobytes() == expected.values.tobytes()


FAULTY = """
import numpy as np
from cowalk.agents import InteractionStrategy, Truth
from cowalk.agents.imperfections.wrapper import Imperfection
from cowalk.estimation import Estimate, MovingAverage, PaperObserver


class FrontEnd:
    delay = 0.0

    def __init__(self, kind: str = "raises"):
        self.kind = kind

    def reset(self, rates):
        self.blocks = 0

    def update(self, wrench, valid):
        self.blocks += 1
        if self.blocks < 30:
            return wrench
        if self.kind == "shape":
            return wrench[:, :2]
        if self.kind == "nan":
            return wrench * np.nan
        if self.kind == "complex":
            return wrench * 1j
        raise ZeroDivisionError("no samples")


class Smoother(MovingAverage):
    def __init__(self, kind: str = "raises"):
        super().__init__()
        self.kind = kind

    def update(self, value):
        found = super().update(value)
        if self.kind == "raises":
            raise KeyError("window")
        answers = {"none": None, "nan": found * np.nan, "shape": np.zeros(3), "complex": found + 1j}
        return answers[self.kind]


class Observer(PaperObserver):
    columns = {"temper": "1"}

    def __init__(self, kind: str = "raises"):
        self.kind = kind

    def update(self, sample, own_wish):
        found = super().update(sample, own_wish)
        if sample.time < 1.0:
            return found
        if self.kind == "tuple":
            return found.stubbornness, found.wish
        if self.kind == "nan":
            return Estimate(found.stubbornness, found.wish * np.nan)
        if self.kind == "extras":
            return Estimate(found.stubbornness, found.wish, extras={"mood": 0.5})
        if self.kind == "number":
            return Estimate(found.stubbornness, found.wish, extras=0.5)
        if self.kind == "text":
            return Estimate(found.stubbornness, found.wish, extras={"temper": "bad"})
        if self.kind == "three":
            return Estimate(np.zeros(3), found.wish)
        if self.kind == "beyond":
            return Estimate(np.array([0.5, 5.0]), found.wish)
        if self.kind == "complex":
            return Estimate(found.stubbornness, found.wish + 0.1j)
        if self.kind == "float":
            return Estimate(0.5, found.wish)
        if self.kind == "writes":
            own_wish[:] = 9.0
        return np.ones(3) @ np.ones(2)


class Imperfect(Imperfection):
    def distort(self, force, observation):
        raise OSError("no hand")


class Talker(InteractionStrategy):
    columns = {"urgency": "1"}

    def utility_loss(self, smoothed):
        return np.zeros_like(smoothed)

    def agree(self, negotiation):
        if type(self) is Mute:
            return negotiation.own
        from dataclasses import replace
        return replace(super().agree(negotiation), extras={"hurry": 1.0})


class Deaf:
    def reset(self, rates): pass
    def update(self, value): return value


class Mute(Talker):
    pass


class Mumbler(Talker):
    columns = {"hurry": "1"}

    def belief(self):
        found = super().belief()
        found.extras = {"hurry": "very"}
        return found
"""
FRONT_END = "automation.front_end=faulty:FrontEnd"
OBSERVER = "automation.observer=faulty:Observer"


@pytest.mark.parametrize(
    ("changes", "who", "what"),
    [
        ([FRONT_END], "front end 'faulty:FrontEnd'", "ZeroDivisionError: no samples"),
        (
            [FRONT_END, "automation.front_end.parameters.kind=shape"],
            "front end 'faulty:FrontEnd'",
            "array of shape (12, 2); it must be the block of samples, cleaned",
        ),
        (["automation.smoother=faulty:Smoother"], "smoother 'faulty:Smoother'", "KeyError"),
        ([OBSERVER], "observer 'faulty:Observer'", "ValueError"),
        (
            [OBSERVER, "automation.observer.parameters.kind=tuple"],
            "observer 'faulty:Observer'",
            "it must be an Estimate",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=nan"],
            "observer 'faulty:Observer'",
            "gave wish = [nan nan]",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=extras"],
            "observer 'faulty:Observer'",
            "gave extras ['mood'] that its columns do not declare",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=number"],
            "observer 'faulty:Observer'",
            "gave extras 0.5; they must be numbers by name",
        ),
        (
            [FRONT_END, "automation.front_end.parameters.kind=nan"],
            "front end 'faulty:FrontEnd'",
            "samples that are not finite",
        ),
        (
            ["automation.smoother=faulty:Smoother", "automation.smoother.parameters.kind=none"],
            "smoother 'faulty:Smoother'",
            "gave None; it must be a number",
        ),
        (
            ["automation.smoother=faulty:Smoother", "automation.smoother.parameters.kind=nan"],
            "smoother 'faulty:Smoother'",
            "gave nan; it must be finite",
        ),
        (
            ["automation.smoother=faulty:Smoother", "automation.smoother.parameters.kind=shape"],
            "smoother 'faulty:Smoother'",
            "an array of shape (3,); it must be a number",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=text"],
            "observer 'faulty:Observer'",
            "gave extras with temper = 'bad'; it must be a number",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=three"],
            "observer 'faulty:Observer'",
            "gave stubbornness = an array of shape (3,)",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=float"],
            "observer 'faulty:Observer'",
            "gave stubbornness = 0.5; it must be an array of real numbers of shape (2,)",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=beyond"],
            "observer 'faulty:Observer'",
            "gave stubbornness = [0.5 5. ]; it must lie in [0, 1]",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=complex"],
            "observer 'faulty:Observer'",
            "gave wish = an array of complex128 of shape (2,); it must be an array of real",
        ),
        (
            [FRONT_END, "automation.front_end.parameters.kind=complex"],
            "front end 'faulty:FrontEnd'",
            "gave an array of complex128 of shape (12, 6); it must be the block",
        ),
        (
            ["automation.smoother=faulty:Smoother", "automation.smoother.parameters.kind=complex"],
            "smoother 'faulty:Smoother'",
            "it must be a number",
        ),
        (
            [OBSERVER, "automation.observer.parameters.kind=writes"],
            "observer 'faulty:Observer'",
            "ValueError: assignment destination is read-only",
        ),
        (
            ["automation=faulty:Mumbler"],
            "automation 'faulty:Mumbler'",
            "belief().extras has hurry = 'very'; it must be one number",
        ),
        (
            ["human.imperfections=[{name: 'faulty:Imperfect'}]"],
            "imperfection 'faulty:Imperfect'",
            "OSError: no hand",
        ),
        (
            ["automation=faulty:Talker"],
            "automation 'faulty:Talker'",
            "belief().extras has 'hurry'; columns declares urgency",
        ),
        (
            ["automation=faulty:Mute"],
            "automation 'faulty:Mute'",
            "agree() gave an array of shape (2,); it must be an Agreement",
        ),
        (
            ["automation.observer=faulty:Deaf"],
            "observer 'faulty:Deaf'",
            "TypeError: Deaf.reset() takes 2 positional arguments",
        ),
        (
            ["automation.front_end=faulty:Deaf"],
            "front end 'faulty:Deaf'",
            "TypeError: Deaf.update() takes 2 positional arguments",
        ),
    ],
)
def test_a_part_that_fails_is_blamed_by_its_own_name(changes, who, what, tmp_path, monkeypatch):
    (tmp_path / "faulty.py").write_text(FAULTY)
    monkeypatch.syspath_prepend(tmp_path)
    result = run(load("puddle", [*changes, "plant=unicycle", "duration=5", "expect={}"]))
    assert result.error is not None
    assert result.error.startswith(who), result.error
    assert what in result.error
    assert "\n" not in result.error


def test_what_automation_and_observer_add_becomes_columns(tmp_path, monkeypatch):
    text = FAULTY.replace('extras={"hurry": 1.0}', 'extras={"urgency": negotiation.time}')
    (tmp_path / "talking.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    swap = ["automation=talking:Talker", "plant=unicycle", "duration=5", "expect={}"]
    trace = run(load("puddle", swap)).trace
    assert trace.units["urgency"] == "1"
    instants = np.flatnonzero(trace["negotiated"])
    np.testing.assert_array_equal(instants, np.arange(0, 100, 14))
    np.testing.assert_allclose(trace["urgency"][instants], 0.05 * instants)
    held = np.repeat(trace["urgency"][instants], 14)[:100]
    np.testing.assert_array_equal(trace["urgency"], held)


ADDING = ["automation=talking:Talker", "plant=unicycle", "duration=5"]


def test_expectations_may_speak_of_columns_that_parts_add(tmp_path, monkeypatch):
    text = FAULTY.replace('extras={"hurry": 1.0}', 'extras={"urgency": negotiation.time}')
    (tmp_path / "talking.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    holds, fails = "always (urgency < 5.0)", "always (urgency < 1.0)"
    result = run(load("puddle", [*ADDING, f"expect={{soon: '{holds}', sooner: '{fails}'}}"]))
    assert [verdict.passed for verdict in result.verdicts] == [True, False]
    with pytest.raises(InputError, match="urgenzy"):
        load("puddle", [*ADDING, "expect={soon: 'always (urgenzy < 5.0)'}"])


def test_a_column_that_every_trace_has_cannot_be_added(tmp_path, monkeypatch):
    text = FAULTY.replace('columns = {"urgency": "1"}', 'columns = {"clearance": "m"}')
    (tmp_path / "clashing.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(InputError, match="column 'clearance': every trace has it"):
        load("puddle", ["automation=clashing:Talker", "expect={}"])


def test_strategy_and_observer_cannot_add_the_same_column():
    class Talking(NeverYields):
        columns: ClassVar = {"urgency": "1"}

    class Telling(PaperObserver):
        columns: ClassVar = {"urgency": "N"}

    with pytest.raises(InputError, match="the strategy adds a column 'urgency' too") as refused:
        Talking(observer=Telling())
    assert refused.value.at == ("observer", "columns")


def test_reward_columns_add_up_to_the_rewards():
    trace = run(load("puddle", ["plant=unicycle", "duration=5", "expect={}"])).trace
    for seat in ("human", "automation"):
        terms = [trace[name] for name in trace.units if name.startswith(f"reward_{seat}_")]
        assert len(terms) == 7
        np.testing.assert_allclose(np.sum(terms, axis=0), trace[f"reward_{seat}"], atol=1e-15)
    assert np.ptp(trace["reward_human_effort"]) > 0.001


def test_keys_and_columns_that_were_renamed_are_refused_with_the_new_name(tmp_path, monkeypatch):
    monkeypatch.setitem(validation.RENAMED, "automation.negotiation.epoch", "period")
    with pytest.raises(InputError, match=r"negotiation\.epoch is called period now"):
        load("puddle", ["automation.negotiation.epoch=0.7"])
    trace = run(load("puddle", ["plant=unicycle", "duration=1", "expect={}"])).trace
    trace.write(tmp_path / "trace.parquet")
    monkeypatch.setitem(trace_module.RENAMED, "clearance", "gap")
    with pytest.raises(InputError, match="column 'clearance' is called 'gap' now"):
        Trace.read(tmp_path / "trace.parquet")
    monkeypatch.setattr(trace_module, "FORMAT", 1)
    with pytest.raises(InputError, match="written in form 3, this cowalk reads up to 1"):
        Trace.read(tmp_path / "trace.parquet")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda table: table.replace_schema_metadata({"cowalk.format": "new"}), "whole number"),
        (lambda table: table.set_column(1, "x", [["left"] * len(table)]), "'x' holds string"),
    ],
)
def test_a_file_that_is_no_trace_is_refused(change, said, tmp_path):
    file = tmp_path / "trace.parquet"
    run(load("puddle", ["plant=unicycle", "duration=1", "expect={}"])).trace.write(file)
    parquet.write_table(change(parquet.read_table(file)), file)
    with pytest.raises(InputError, match=said):
        Trace.read(file)


@pytest.mark.parametrize("wrong", [None, "puddle", {}])
def test_what_a_loop_of_ones_own_needs_refuses_nonsense(wrong):
    for call in (seeds_of, build_agents, lambda given: situation_of(given, make_env("puddle"))):
        with pytest.raises(InputError, match="a Scenario, as load returns one"):
            call(wrong)
    with pytest.raises(InputError, match="a CowalkEnv"):
        situation_of(load("puddle"), wrong)


def test_rows_say_what_the_sensor_made_of_the_true_wrench_and_what_wheels_are_asked():
    result = run(load("puddle", ["sensor=laboratory", "duration=5", "expect={}"]))
    trace = result.trace
    error = trace["fx"] - trace["interaction_force_x"]
    assert 0.001 < np.abs(error).max() < 1.0
    rim = 0.1 * trace["wheel_left"], 0.1 * trace["wheel_right"]
    np.testing.assert_allclose(0.5 * (rim[0] + rim[1]), trace["v_cmd"], atol=1e-12)
    np.testing.assert_allclose((rim[1] - rim[0]) / 0.42, trace["omega_cmd"], atol=1e-12)
    exact = run(load("puddle", ["sensor=none", "duration=5", "expect={}"])).trace
    np.testing.assert_array_equal(exact["fx"], exact["interaction_force_x"])


def test_samples_are_kept_at_the_sensors_rate_when_asked_for(tmp_path):
    scenario = load("puddle", ["sensor=industrial", "duration=4", "expect={}"])
    result = run(scenario, samples=True)
    assert run(scenario).samples is None
    columns = result.samples.columns()
    assert len(result.samples) == 4 * 240
    np.testing.assert_allclose(np.diff(columns["t"]), 1.0 / 240.0)
    for axis in "xy":
        mean = columns[f"measured_force_{axis}"].reshape(-1, 12).mean(axis=1)
        np.testing.assert_allclose(mean, result.trace[f"f{axis}"], atol=1e-12)
        true = columns[f"interaction_force_{axis}"].reshape(-1, 12).mean(axis=1)
        np.testing.assert_allclose(true, result.trace[f"interaction_force_{axis}"], atol=1e-12)
    assert 0.0 < np.abs(columns["measured_force_x"] - columns["interaction_force_x"]).max() < 30.0
    assert set(np.unique(columns["valid"])) <= {0.0, 1.0}
