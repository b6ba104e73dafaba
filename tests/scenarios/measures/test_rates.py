"""What was done is the same however often it is looked at: the same twists and forces, replayed."""

from functools import cache

import numpy as np
import pytest

from cowalk.agents import Belief, Truth
from cowalk.scenarios import Recorder, load, make_env, metrics, run, situation_of

CASES = {"puddle": "bullet", "carry": "bullet", "doorway": "unicycle"}
UNKNOWN = Truth(np.full(2, np.nan), np.full(2, np.nan))


class Silent:
    """Sits in a seat; what it would do is replayed from elsewhere."""

    def reset(self, rng, situation):
        pass

    def act(self, observation):
        raise AssertionError

    def truth(self):
        return UNKNOWN

    def belief(self):
        return Belief()


@cache
def walked(name):
    plant = CASES[name]
    narrow = ["world.corridor.doorways.0={width: 1.9}"] if name == "doorway" else []
    scenario = load(name, [f"plant={plant}", "duration=12.0", *narrow])
    assert scenario.rates.control == 20
    return scenario, run(scenario.model_copy(update={"expect": {}})).trace


@cache
def replayed(name, control):
    """Return the metrics of a run at 20 Hz whose actions are held through steps of another rate."""
    scenario, trace = walked(name)
    update = {"rates": load(name, [f"rates.control={control}"]).rates}
    scenario = scenario.model_copy(update=update)
    env = make_env(scenario)
    env.reset(seed=7)
    recorder = Recorder(env, Silent(), Silent())
    situation = situation_of(scenario, env)
    side = -1.0 if env.plant.steers_from_behind else 1.0  # a trace has forces in base axes
    for row in range(len(trace)):
        force = np.array([trace["fx_intent"][row], side * trace["fy_intent"][row]])
        twist = np.array([trace["v_cmd"][row], trace["omega_cmd"][row]])
        for _ in range(control // 20):
            _, rewards, _, _, infos = env.step({"human": force, "automation": twist})
            recorder.step(rewards, infos)
    env.close()
    found = metrics(recorder.trace.columns(), situation)
    return {metric: entry["value"] for metric, entry in found.items()}


@pytest.mark.parametrize("control", [40, 80])
@pytest.mark.parametrize("name", CASES)
def test_work_and_effort_do_not_depend_on_the_control_rate(name, control):
    slow, fast = replayed(name, 20), replayed(name, control)
    assert abs(slow["work"]) > 0.1
    assert fast["work"] == pytest.approx(slow["work"], rel=0.01)
    for metric in ("intended effort", "squared intended effort, sideways", "progress"):
        assert fast[metric] == pytest.approx(slow[metric], rel=0.01), metric


def test_work_is_what_was_done_at_the_handle_not_what_a_sensor_read():
    scenario, trace = walked("carry")
    work = run(scenario).summary["metrics"]["work"]["value"]
    assert work == pytest.approx(trace["work"].sum())
    read = float(np.sum(trace["fx"] * trace["v"])) * scenario.rates.period
    assert abs(work - read) > 0.5, "the reading leaves out most of it here"
    noisy = scenario.model_copy(update={"sensor": load("carry", ["sensor=low-cost"]).sensor})
    replay = run(noisy)
    assert np.ptp(replay.trace["fx"] - trace["fx"][: len(replay.trace)]) > 0.0
