"""What `cowalk check` accepts can begin, and its formulas can be judged."""

import random

import pytest
import yaml

from cowalk.scenarios import load, run, scenario_library
from cowalk.scenarios.expect import verdict
from cowalk.scenarios.files.loading import faults
from cowalk.scenarios.running.trial import trial

GOOD = "expect:\n  walks: eventually (x >= 1.0)\n"
ONLY_WHEN_RUN = """
class Breaks:
    def reset(self, rng, situation): pass
    def act(self, observation): return 1 / 0
    def truth(self): pass
"""


def test_a_scenario_that_can_begin_is_accepted(scenario_file, cowalk):
    file = scenario_file(more=GOOD)
    assert trial(load(file)) == []
    assert cowalk("check", file) == (0, f"{file}: no fault\n", "")


def test_a_part_that_fails_at_its_first_step_is_found_by_check(scenario_file, folder, cowalk):
    (folder / "breaking_models.py").write_text(ONLY_WHEN_RUN)
    file = scenario_file(("name: steady", "name: breaking_models:Breaks"))
    assert faults(file, trust=True) == []
    code, out, _ = cowalk("check", "--trust", file)
    assert code == 2
    assert "it takes no step: human 'breaking_models:Breaks'" in out
    assert len(out.splitlines()) == 1


def test_a_formula_that_cannot_be_judged_is_found_at_its_line(scenario_file, cowalk, monkeypatch):
    def stumbles(*given):
        raise AttributeError("rtamt has no such operator")

    monkeypatch.setattr(verdict, "judge", stumbles)
    file = scenario_file(more=GOOD)
    code, out, _ = cowalk("check", file)
    assert code == 2
    assert f"{file}:9: expect.walks = 'eventually (x >= 1.0)': it cannot be judged" in out


NONSENSE = {
    "bounds.upper=[1200.0, 1.0]": "bounds.upper.0 = 1200.0: must lie between",
    "automation.negotiation.horizon=1e308": "must lie between 0.001 and 1000 s",
    "automation.negotiation.horizon=1e-300": "must lie between 0.001 and 1000 s",
    "automation.negotiation.period=700": "must not be longer than the run, duration = 3 s",
    "automation.negotiation.period=1e30": "must lie between",
    "automation.negotiation.force_window=1e30": "must lie between 0 and 3600 s",
    "automation.negotiation.force_window=100": "must not be longer than the run",
    "world.corridor={width: 3e6}": "must lie between 0.001 and 1000 m",
    "human.parameters.level=[50, -7]": "must lie between 0 and 1",
    "human={name: open-loop, parameters: {profile: [[0.0, -1e308, 0.0]]}}": "must lie between",
}


@pytest.mark.parametrize("assignment", NONSENSE)
def test_what_no_person_or_robot_can_have_is_refused_with_what_would_be_right(
    scenario_file, assignment, cowalk
):
    code, out, error = cowalk("run", scenario_file(), "--set", assignment)
    assert (code, out) == (2, "")
    assert NONSENSE[assignment] in error
    assert len(error.splitlines()) == 1


def test_a_usual_negotiation_period_may_be_longer_than_a_short_run(scenario_file):
    assert load(scenario_file(), ["duration=0.5"]).duration == 0.5


@pytest.mark.parametrize("seed", range(24))
def test_what_is_accepted_takes_a_step(seed, folder):
    """Numbers of shipped scenarios changed within reason: where check finds nothing, it walks."""
    rng = random.Random(seed)
    file = rng.choice(sorted(scenario_library().values()))
    data = yaml.safe_load(file.read_text())
    for _ in range(rng.randrange(1, 4)):
        place, key = rng.choice(numbers(data))
        place[key] *= rng.choice([0.1, 0.5, 0.9, 1.1, 2.0, 10.0, -1.0])
    changed = folder / "changed.scenario.yaml"
    changed.write_text(yaml.safe_dump(data))
    if not faults(changed):
        scenario = load(changed)
        assert trial(scenario) == []
        short = scenario.model_copy(update={"duration": 5.0 * scenario.rates.period, "expect": {}})
        assert run(short).error is None


def numbers(data):
    """Return what holds each number of a document, and its key there."""
    found = []
    for key, value in data.items() if isinstance(data, dict) else enumerate(data):
        if isinstance(value, dict | list):
            found += numbers(value)
        elif isinstance(value, float):
            found.append((data, key))
    return found
