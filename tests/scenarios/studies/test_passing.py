"""Who passes a scenario, and why the others do not."""

import json

import numpy as np
import pytest

from cowalk.scenarios import load, load_population, with_person
from cowalk.scenarios.running.runner import run
from cowalk.scenarios.studies import passing
from cowalk.scenarios.studies.passing import people_who_pass
from cowalk.sim.basics.errors import InputError

EXPECT = {
    "they get on": "eventually (x >= 1.5)",
    "it yields": "eventually (abs(omega) >= 0.02)",
}
PEOPLE = """\
name: two kinds
people:
  - {kind: any, strength: {forward: 6.0, sideways: 6.0}}
groups:
  - human: {name: steady, parameters: {level: [0.0, 0.0]}}
  - human:
      name: steady
      parameters: {level: [0.0, {distribution: uniform, loc: 0.8, scale: 0.2}]}
      intention: {path: {points: [[0.0, 0.6], [20.0, 0.6]]}, easing: 0.1}
"""


@pytest.fixture(scope="module")
def scenario():
    walk = load("puddle", ["plant=unicycle"])
    return walk.model_copy(update={"duration": 3.0, "expect": EXPECT})


@pytest.fixture
def population(tmp_path):
    file = tmp_path / "two.population.yaml"
    file.write_text(PEOPLE)
    return load_population(file)


def test_those_pass_for_whom_everything_holds(scenario, population):
    found = people_who_pass(scenario, population, 12, seed=3, jobs=1)
    own, never = found.shares
    assert (own.automation, never.automation) == ("stubbornness", "never-yields")
    insisting = [p.human.parameters["level"][1] > 0.0 for p in found.drawn]
    assert 0 < sum(insisting) < 12
    # Whoever insists is conceded something by the one and nothing by the other.
    assert [outcome.passed for outcome in own.outcomes] == insisting
    assert own.passed == sum(insisting)
    assert own.failed == {"they get on": 0, "it yields": 12 - own.passed}
    assert (never.passed, never.failed["it yields"]) == (0, 12)
    assert own.ends == never.ends == {"time": 12}
    difference = found.differences["never-yields"]
    assert difference.value == own.share.value == own.passed / 12
    assert 0.0 < difference.low < difference.value < difference.high < 1.0
    # None of twelve is not none of all.
    assert never.share.low == 0.0
    assert 0.1 < never.share.high < 0.4


def test_everybody_walks_as_they_would_alone_and_again_the_same(scenario, population):
    found = people_who_pass(scenario, population, 4, seed=3, jobs=1)
    assert found == people_who_pass(scenario, population, 4, seed=3, jobs=1)
    assert found.drawn == tuple(population.draw(4, seed=3))
    for number, person in enumerate(found.drawn):
        alone = scenario.model_copy(update={"seed": scenario.seed + number})
        result = run(with_person(alone, person))
        assert result.passed is found.shares[0].outcomes[number].passed


def test_an_automation_is_judged_with_the_same_people_and_noise(scenario, monkeypatch):
    seen = {}
    monkeypatch.setattr(
        passing, "_walk", lambda *task: seen.setdefault(len(seen), task) and OUTCOME
    )
    healthy = load_population("healthy-adults")
    people_who_pass(scenario, healthy, 3, automations=("stubbornness", "always-yields"), jobs=1)
    for one, other in zip(list(seen.values())[::2], list(seen.values())[1::2], strict=True):
        assert one[0].seed == other[0].seed
        assert one[1] is other[1]
        assert one[0].automation.name != other[0].automation.name
    assert len({scenario.seed for scenario, _ in seen.values()}) == 3


OUTCOME = passing.Outcome(True, (), "goal")

FAULTY = """
from cowalk.agents.humans.steady import SteadyHuman

class Sleepy(SteadyHuman):
    def act(self, observation):
        if float(observation["time"][0]) > 1.0:
            raise RuntimeError("asleep")
        return super().act(observation)
"""


def test_who_makes_a_run_end_is_one_who_did_not_pass(scenario, tmp_path):
    (tmp_path / "sleepers.py").write_text(FAULTY)
    file = tmp_path / "two.population.yaml"
    file.write_text("name: sleepers\ngroups: [{human: {name: 'sleepers:Sleepy'}}]\n")
    found = people_who_pass(scenario, load_population(file, trust=True), 2, jobs=1)
    for share in found.shares:
        assert share.passed == 0
        ((end, count),) = share.ends.items()
        assert end.startswith("aborted: human 'sleepers:Sleepy' failed: RuntimeError: asleep")
        assert count == 2


def test_who_cannot_be_put_into_the_scenario_did_not_pass(tmp_path):
    text = "name: giants\npeople: [{body: {height: 2.2, mass: 30.0}}]\ngroups: [{human: steady}]\n"
    file = tmp_path / "giants.population.yaml"
    file.write_text(text)
    walk = load("walk").model_copy(
        update={"duration": 1.0, "expect": {"it moves": "always (x >= 0)"}}
    )
    body = {"grip": {"kind": "compliant", "stiffness": [1e9, 1e9, 1e9]}}
    stiff = walk.model_copy(update={"plant": walk.plant.model_copy(update={"parameters": body})})
    found = people_who_pass(stiff, load_population(file), 2, jobs=1)
    assert all(share.passed == 0 for share in found.shares)
    assert all(end.startswith("cannot be built: ") for s in found.shares for end in s.ends)


def test_what_cannot_be_counted_is_refused(scenario, population):
    with pytest.raises(InputError, match="expects nothing"):
        people_who_pass(scenario.model_copy(update={"expect": {}}), population, 2)
    with pytest.raises(InputError, match="people = 1: an interval needs at least 2"):
        people_who_pass(scenario, population, 1)
    with pytest.raises(InputError, match="unknown automation 'stuborness'"):
        people_who_pass(scenario, population, 2, automations=("stuborness",))


def test_the_command_prints_shares_reasons_and_ends(cowalk, scenario_file, tmp_path):
    changes = (("duration: 3.0", "duration: 1.0"), ("automation: never-", "automation: always-"))
    file = scenario_file(*changes, more="expect: {it moves: always (x >= 0)}\n")
    people = tmp_path / "two.population.yaml"
    people.write_text(PEOPLE)
    arguments = ("humans", "pass", file, "--population", people, "-n", "2", "--seed", "5")
    code, out, _ = cowalk(*arguments)
    assert code == 0
    out = " ".join(out.split())
    for told in ("never-yields", "always-yields", "for whom it did not hold", "their run ended"):
        assert told in out
    code, out, _ = cowalk(*arguments, "--json")
    found = json.loads(out)
    assert (code, found["seed"], len(found["people"])) == (0, 5, 2)
    for each in found["automations"]:
        share = each["share"]
        assert share["low"] <= share["value"] <= share["high"]
        told = [p["outcomes"][each["automation"]]["passed"] for p in found["people"]]
        assert np.mean(told) == share["value"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--population", "nobody"), "--population unknown population 'nobody'"),
        (("--human", "steady"), "--human steady: people of a population bring their own"),
        (("--set", "human.parameters.gain=2"), "only human.intention can be set here"),
        (("--against", "nobody"), "unknown automation 'nobody'"),
        (("--set", "expect:={}"), "this scenario expects nothing"),
    ],
)
def test_a_mistake_gets_one_line(cowalk, arguments, message):
    code, out, error = cowalk("humans", "pass", "puddle", "-n", "2", *arguments)
    assert (code, out) == (2, "")
    assert message in error
    assert error.count("\n") == 1
