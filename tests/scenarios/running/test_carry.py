"""Carrying together: what agents get and give where hands hold on behind the base."""

import numpy as np
import pytest

from cowalk.scenarios import load, make_env, run
from cowalk.scenarios.files.schema import Component
from cowalk.sim import InputError
from cowalk.sim.env import env as environment
from cowalk.sim.env import perception
from cowalk.sim.env.steering import as_felt, as_pushed


def short(**changes):
    return load("carry").model_copy(update={"duration": 15.0, "expect": {}, **changes})


def test_whoever_wants_to_turn_left_pushes_the_tail_to_the_right():
    trace = run(short()).trace
    missing = trace["true_omega"] - trace["omega"]
    asked = np.abs(missing) > 0.05
    assert asked.sum() > 20
    assert (np.sign(trace["fy_intent"][asked]) == -np.sign(missing[asked])).all()


def test_a_push_at_the_tail_is_read_as_the_turn_that_was_meant():
    pushing = Component(
        name="open-loop", parameters={"profile": [[0.0, 0.0, 0.0], [5.0, 0.0, 4.0]]}
    )
    scenario = load("carry")
    trace = run(short(human=scenario.human.model_copy(update=pushing.model_dump()))).trace
    late = trace["t"] > 8.0
    assert (trace["fy_intent"][late] == -4.0).all()
    assert trace["fy"][late].mean() < -2.0
    assert (trace["est_omega"][late] > trace["omega"][late]).mean() > 0.9


def test_pushing_to_the_side_one_wants_to_turn_to_goes_wrong_at_the_tail(monkeypatch):
    assert run(load("carry")).passed
    monkeypatch.setattr(environment, "as_pushed", lambda force, _: force)
    monkeypatch.setattr(perception, "as_felt", lambda wrench, _: wrench.copy())
    assert not run(load("carry")).passed


@pytest.mark.parametrize(
    ("scenario", "behind"), [("carry", True), ("walk", False), ("paper-open-loop", False)]
)
def test_only_the_stretcher_is_steered_from_behind(scenario, behind):
    env = make_env(scenario)
    assert env.plant.steers_from_behind is behind
    env.close()


@pytest.mark.parametrize("scenario", ["carry", "walk"])
def test_agents_feel_and_read_sideways_force_with_the_sign_of_the_turn_it_asks_for(scenario):
    env = make_env(load(scenario, ["sensor=none", "start=standing"]))
    env.reset(seed=0)
    for _ in range(10):
        seen, *_ = env.step({"human": np.array([1.0, 4.0]), "automation": np.array([0.5, 0.0])})
    sign = -1.0 if env.plant.steers_from_behind else 1.0
    assert env.applied[0] == (1.0, sign * 4.0)
    turned = env.plant_state.wrench_on_base * [1.0, sign, 1.0, 1.0, 1.0, 1.0]
    for seat in ("human", "automation"):
        np.testing.assert_array_equal(seen[seat]["wrench"], turned)
        np.testing.assert_array_equal(seen[seat]["force"], turned[:, :2])
    assert seen["human"]["force"][-1, 1] > 2.0
    env.close()


def test_turning_the_sign_twice_changes_nothing():
    wrench = np.arange(12.0).reshape(2, 6)
    np.testing.assert_array_equal(as_felt(wrench, True)[:, 1], [-1.0, -7.0])
    np.testing.assert_array_equal(as_felt(as_felt(wrench, True), True), wrench)
    assert as_pushed((1.0, 2.0), True) == (1.0, -2.0)
    assert as_pushed((1.0, 2.0), False) == (1.0, 2.0)


@pytest.mark.parametrize(
    ("sensor", "mass"), [("industrial", 8.0), ("laboratory", 5.0), ("low-cost", 4.0)]
)
def test_on_wheels_the_weight_of_what_is_carried_steers_nobody(sensor, mass):
    """What each preset has the range for: the empty stretcher's 8 kg or as much of it as it can."""
    wheels = "plant.parameters.drive.kind=wheels", f"plant.parameters.coupling.mass={mass}"
    result = run(load("carry", (*wheels, f"sensor={sensor}")))
    # Before the human sees the puddle only the weight could turn them; without a tare it is 1.2 m.
    ahead = result.trace["x"] < 4.0
    assert np.abs(result.trace["y"][ahead]).max() < 0.1
    assert result.summary["end"] == "goal"
    assert result.summary["sensor"]["saturated"] < 0.1


def test_a_sensor_too_small_for_the_load_is_refused_with_what_would_do():
    with pytest.raises(InputError, match=r"torque_range = 20 N m: .* 25.2 N m about y.*80%"):
        run(load("carry", ("plant.parameters.drive.kind=wheels", "sensor=laboratory")))
