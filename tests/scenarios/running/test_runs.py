"""Whole runs: every shipped scenario, determinism, what a run folder holds, runs that break."""

import json
import subprocess
import sys

import numpy as np
import pyarrow.parquet as pq
import pytest

from cowalk.agents import AUTOMATIONS, HUMANS
from cowalk.estimation.registry import SMOOTHERS
from cowalk.scenarios import load, make_env, run, write_run
from cowalk.scenarios.files.shipped import scenario_library
from cowalk.scenarios.trace.columns import UNITS
from cowalk.scenarios.trace.trace import Trace
from cowalk.sim.basics.errors import InputError
from cowalk.sim.plant.registry import PLANTS

STILL = "plant.parameters.gait.enabled=false"


def trace_of(source, *overrides):
    result = run(load(source, overrides))
    assert result.error is None, result.error
    return result.trace


@pytest.fixture(scope="module")
def puddle():
    return run(load("puddle"))


@pytest.mark.parametrize("name", list(scenario_library()))
def test_every_scenario_repeats_bit_for_bit_in_another_process(name):
    here = trace_of(name)
    code = (
        "import sys; from cowalk.scenarios import load, run; "
        f"sys.stdout.buffer.write(run(load({name!r})).trace.values.tobytes())"
    )
    there = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout
    assert len(here) > 100
    assert here.values.tobytes() == there[-here.values.nbytes :]


@pytest.mark.parametrize("plant", PLANTS.names())
@pytest.mark.parametrize("human", HUMANS.names())
@pytest.mark.parametrize("automation", AUTOMATIONS.names())
def test_every_human_meets_every_automation_on_every_plant(
    plant, human, automation, stand_in_recording
):
    parts = [f"plant={plant}", f"human={human}", f"automation={automation}"]
    if human == "recorded":  # the one model without a default for everything
        parts.append(f"human.parameters.file={stand_in_recording}")
    trace = trace_of("puddle", *parts, "duration=4")
    assert len(trace) == 80
    # The paper's observer states no deviation, and the unicycle has no wheels.
    unknown = {name for name in trace.units if "deviation" in name}
    if plant == "unicycle":
        unknown |= {"wheel_left", "wheel_right", "drive_force", "drive_torque"}
    if human in {"open-loop", "recorded"}:  # of whose wish nobody knows anything
        unknown |= {name for name in trace.units if name.startswith("true_")}
        unknown -= {"true_insistence_v", "true_insistence_omega"}
    for name, column in trace.columns().items():
        assert np.isnan(column).all() if name in unknown else np.isfinite(column).all(), name


@pytest.mark.parametrize("smoother", SMOOTHERS.names())
def test_every_smoother_runs_in_the_loop(smoother):
    trace = trace_of("puddle", f"automation.smoother={smoother}", "duration=8", "plant=unicycle")
    assert np.ptp(trace["smoothed_stubbornness_omega"]) > 0.05


GLIDING = "plant.parameters.gait.enabled=false"


def test_the_walked_path_clears_the_puddle(puddle):
    assert puddle.summary["end"] == "goal"
    assert puddle.trace["clearance"].min() > 0.05
    assert puddle.passed


def test_the_force_is_the_constraints_and_not_the_intent(puddle):
    """The body between hand and handle adds dynamics, and far more of them while it walks."""
    apart = []
    for trace in (trace_of("puddle", "sensor=none", GLIDING), puddle.trace):
        walking = trace["t"] > 3.0
        intent = trace["fy_intent"][walking]
        added = trace["fy"][walking] - intent
        apart.append(added.std())
        if apart[1:]:
            # Legs know nothing of what the hand intends.
            assert abs(np.corrcoef(added, intent)[0, 1]) < 0.1
        else:
            assert np.corrcoef(trace["fy"][walking], intent)[0, 1] > 0.95
    gliding, walked = apart
    assert gliding > 0.01  # there is no noise that could be it
    assert walked > 5.0 * gliding


def test_an_automation_that_never_yields_changes_the_humans_force():
    # Without gait, through which an automation that yields shakes whom it walks with.
    puddle, stubborn = (
        run(load("puddle", ["sensor=none", GLIDING, f"automation={name}"]))
        for name in ("stubbornness", "never-yields")
    )
    assert stubborn.trace["clearance"].min() < 0.0
    assert not stubborn.passed
    # On the way to the puddle: whoever was led through it is there at once.
    ahead = [each.trace["fy_intent"][each.trace["x"] < 9.0] for each in (puddle, stubborn)]
    mean = [np.abs(force).mean() for force in ahead]
    assert mean[1] > 1.15 * mean[0]


REUSED = """
import numpy as np
from cowalk.agents import Belief

class Counting:
    def reset(self, rng, situation): self.now = Belief()
    def act(self, observation):
        self.now.negotiation += 1
        return np.array([0.8, 0.0])
    def belief(self): return self.now
"""


def test_a_belief_object_that_is_used_again_is_read_again(tmp_path, monkeypatch):
    (tmp_path / "counting.py").write_text(REUSED)
    monkeypatch.syspath_prepend(tmp_path)
    overrides = ["automation=counting:Counting", "plant=unicycle", "duration=2", "expect={}"]
    result = run(load("puddle", overrides))
    np.testing.assert_array_equal(result.trace["negotiation"], np.arange(1, 41))
    assert write_run(result, tmp_path / "run", figure=False).exists()  # its other beliefs are NaN


def test_the_trace_holds_the_force_that_acted(tmp_path, monkeypatch):
    (tmp_path / "strong.py").write_text(
        BROKEN.replace("np.array([0.0, np.nan])", "np.full(2, 1e6)")
    )
    monkeypatch.syspath_prepend(tmp_path)
    overrides = ["human=strong:NotANumber", "plant=unicycle", "duration=2", "force_limit=12"]
    trace = trace_of("puddle", *overrides)
    np.testing.assert_array_equal(trace["fx_intent"][30:], 12.0)


def test_the_seed_matters_and_the_noise_is_the_sensors():
    """Without a sensor's faults and a gait, whose phase is drawn, nothing else is random."""
    quiet = [trace_of("puddle", f"seed={seed}", "sensor=none", GLIDING) for seed in (1, 2)]
    assert quiet[0].values.tobytes() == quiet[1].values.tobytes()
    one, two, same = (trace_of("puddle", f"seed={seed}", STILL) for seed in (1, 2, 2))
    assert one.values.tobytes() != two.values.tobytes()
    assert two.values.tobytes() == same.values.tobytes()


def test_the_trace_holds_what_the_sensor_read_in_its_own_axes():
    turned = ["plant.parameters.mount={position: [0, 0, -0.1], rpy: [0, 0, 1.5707963267948966]}"]
    columns = trace_of("walk", "duration=3", "expect={}", *turned).columns()
    seen = [columns[f"sensor_{name}"] for name in ("force_x", "force_y", "torque_x", "torque_y")]
    # Its x axis is the base's y, and the handle is 0.1 m above it.
    np.testing.assert_allclose(seen[0], columns["fy"], atol=1e-12)
    np.testing.assert_allclose(seen[1], -columns["fx"], atol=1e-12)
    exact = trace_of("walk", "duration=3", "expect={}", "sensor={}", *turned).columns()
    np.testing.assert_allclose(exact["sensor_torque_x"], 0.1 * exact["fx"], atol=1e-12)
    np.testing.assert_allclose(exact["sensor_torque_y"], 0.1 * exact["fy"], atol=1e-12)
    assert np.abs(exact["sensor_torque_y"]).max() > 0.05


def test_a_trace_from_before_torque_was_measured_is_read_without_it(puddle, tmp_path):
    file = write_run(puddle, tmp_path / "run", figure=False) / "trace.parquet"
    table = pq.read_table(file)
    form_1 = table.column_names[: table.column_names.index("clearance") + 1]
    older = [name for name in form_1 if not name.startswith("sensor_")]
    pq.write_table(table.select(older).replace_schema_metadata(None), file)
    trace = Trace.read(file)
    np.testing.assert_array_equal(trace["fx"], puddle.trace["fx"])
    for later in ("sensor_torque_z", "interaction_force_x", "work", "reward_human"):
        assert np.isnan(trace[later]).all()
    pq.write_table(table.drop_columns(["fx", "clearance"]), file)
    with pytest.raises(InputError, match=r"trace.parquet: not a trace: .* no column fx, clearance"):
        Trace.read(file)


def test_a_run_folder_holds_everything_and_runs_again(puddle, tmp_path):
    folder = write_run(puddle, tmp_path / "run")
    schema = pq.read_schema(folder / "trace.parquet")
    assert {field.name: field.metadata[b"unit"].decode() for field in schema} == UNITS
    np.testing.assert_array_equal(Trace.read(folder / "trace.parquet").values, puddle.trace.values)
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["seed"] == 1
    assert summary["real_time_factor"] > 0.0
    assert {"python", "cowalk", "pybullet", "numpy"} <= set(summary["versions"])
    assert summary["metrics"]["smallest clearance"]["unit"] == "m"
    assert (folder / "figure.png").read_bytes().startswith(b"\x89PNG")
    resolved = load(folder / "scenario.yaml")
    # Defaults are written out, so that the file still gives this run when they have changed.
    assert resolved.human.parameters["growth"] == 0.38
    assert resolved.automation.smoother.parameters == {"window": 5}
    assert resolved.plant.parameters["drive"]["gain_forward"] == 2000.0
    again = run(resolved)
    assert again.trace.values.tobytes() == puddle.trace.values.tobytes()


def test_make_env_builds_the_scenarios_world():
    env = make_env("puddle")
    observations, _ = env.reset(seed=0)
    assert env.world == load("puddle").world
    assert observations["human"]["obstacles"][0, 0] == 1.0
    env.close()


BROKEN = """
import numpy as np
from cowalk.agents import Truth

class Base:
    def reset(self, rng, situation): self.count = 0
    def truth(self): return Truth(np.zeros(2), np.zeros(2))
    def act(self, observation):
        self.count += 1
        return self.force() if self.count > 30 else np.zeros(2)

class NotANumber(Base):
    def force(self): return np.array([0.0, np.nan])

class Infinite(Base):
    def force(self): return np.array([np.inf, 0.0])

class Raises(Base):
    def force(self): raise ZeroDivisionError("division by zero")

class Exits(Base):
    def force(self): raise SystemExit(5)

class ThreeNumbers(Base):
    def force(self): return np.zeros(3)

class AScalar(Base):
    def force(self): return 1.0

class NoTruth(Base):
    def force(self): return np.zeros(2)
    def truth(self): return super().truth() if self.count <= 30 else None
"""


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("NotANumber", "at t = 1.5 s: act() gave [0.0, nan]; the force [fx, fy] in N must be fin"),
        ("Infinite", "at t = 1.5 s: act() gave [inf, 0.0]"),
        ("Raises", "failed at t = 1.5 s: ZeroDivisionError"),
        ("Exits", "failed at t = 1.5 s: SystemExit"),
        ("ThreeNumbers", "act() gave an array of shape (3,); it must be the force"),
        ("AScalar", "act() gave 1.0; it must be the force [fx, fy] in N"),
        ("NoTruth", "truth() gave None; it must be a Truth"),
    ],
)
def test_a_run_that_dies_midway_says_why_and_keeps_its_trace(name, said, tmp_path, monkeypatch):
    (tmp_path / "broken_humans.py").write_text(BROKEN)
    monkeypatch.syspath_prepend(tmp_path)
    result = run(load("puddle", [f"human=broken_humans:{name}", "plant=unicycle"]))
    assert said in result.error
    assert result.error.startswith(f"human 'broken_humans:{name}' ")
    assert "\n" not in result.error
    assert result.summary["end"] == "aborted"
    assert len(result.trace) == 30
    assert not result.passed
    folder = write_run(result, tmp_path / "run", figure=False)
    assert len(Trace.read(folder / "trace.parquet")) == 30


@pytest.mark.parametrize("pace", [0.8, 1.2])
def test_walking_hand_in_hand_is_taken_for_no_wish_at_any_usual_pace(pace):
    result = run(load("walk", (f"pace={pace}",)))
    assert result.passed, result.verdicts
