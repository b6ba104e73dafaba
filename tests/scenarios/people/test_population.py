"""Populations: what ships, what is drawn, and what is said of a faulty file."""

import re
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy import stats

from cowalk.agents.checks.conformance import human_problems
from cowalk.scenarios.files.assembling import build_human
from cowalk.scenarios.files.loading import load
from cowalk.scenarios.people.distribution import KEY, Distribution
from cowalk.scenarios.people.loading import load_population, population_library
from cowalk.scenarios.people.person import with_person
from cowalk.scenarios.running.runner import run
from cowalk.sim.basics.errors import InputError
from cowalk.sim.body.gait import GaitParameters, step_frequency
from cowalk.sim.plant.registry import PLANTS

SHIPPED = sorted(population_library())
EXAMPLE = """\
name: example
groups:
  - weight: 3
    human:
      name: steady
      parameters:
        gain: {distribution: norm, loc: 2.0, scale: 0.5, within: [1.0, 3.0]}
        level: [{distribution: beta, a: 2, b: 3}, 0.5]
      imperfections:
        - tremor
        - {name: gait-ripple, probability: 0.25}
  - human: escalating
"""


@pytest.fixture(scope="module")
def shipped():
    return {name: load_population(name) for name in SHIPPED}


@pytest.fixture
def example(tmp_path):
    def make(text=EXAMPLE):
        file = tmp_path / "example.population.yaml"
        file.write_text(text)
        return load_population(file)

    return make


def test_the_four_populations_ship():
    assert set(SHIPPED) == {"healthy-adults", "frail-and-slow", "determined", "uncertain"}


def reasons(value):
    """Yield the reason of every distribution and group in a file's data."""
    if isinstance(value, dict):
        if KEY in value or "human" in value or "kind" in value or "between" in value:
            yield value.get("because", "")
        for item in value.values():
            yield from reasons(item)
    elif isinstance(value, list):
        for item in value:
            yield from reasons(item)


@pytest.mark.parametrize("name", SHIPPED)
def test_every_number_that_ships_has_its_reason(name):
    found = list(reasons(yaml.safe_load(population_library()[name].read_text())))
    assert len(found) > 15
    assert all(len(reason) > 10 for reason in found)


@pytest.mark.parametrize("plant", PLANTS.names())
@pytest.mark.parametrize("name", SHIPPED)
def test_a_drawn_person_builds_keeps_the_protocol_and_walks(shipped, name, plant):
    scenario = load("puddle", [f"plant={plant}"])
    scenario = scenario.model_copy(update={"duration": 0.5, "expect": {}})
    for person in shipped[name].draw(3, seed=11, plant=plant):
        assert human_problems(build_human(person.human, plant, 0.05)) == []
        result = run(with_person(scenario, person))
        assert result.error is None
        assert len(result.trace) == 10


@pytest.mark.parametrize("name", SHIPPED)
def test_a_draw_repeats_and_longer_draws_begin_alike(shipped, name):
    population = shipped[name]
    assert population.draw(12, seed=4) == population.draw(12, seed=4)
    assert population.draw(12, seed=4)[:5] == population.draw(5, seed=4)
    assert population.draw(5, seed=4) != population.draw(5, seed=5)


def test_a_person_walks_alike_on_every_plant(shipped):
    population = shipped["healthy-adults"]
    pairs = zip(population.draw(5, plant="bullet"), population.draw(5), strict=True)
    for walking, gliding in pairs:
        assert walking.plant == gliding.plant
        assert "gait-ripple" not in [item.name for item in walking.human.imperfections]
        assert gliding.human.imperfections[:-1] == walking.human.imperfections
        ripple, gait = gliding.human.imperfections[-1].parameters, walking.plant["gait"]
        assert ripple["arm_stiffness"] == walking.plant["walker"]["hand_stiffness"]
        pace = walking.human.intention.pace
        sway = GaitParameters(**gait).sway_at(pace)
        assert (ripple["fore_aft_sway"], ripple["lateral_sway"]) == sway
        assert ripple["step_frequency"] == step_frequency(pace, gait["step_frequency"])


def test_the_body_sways_as_drawn_in_pybullet(shipped):
    (person,) = shipped["healthy-adults"].draw(1, seed=2, plant="bullet")
    scenario = with_person(load("walk"), person)
    plant = PLANTS.get("bullet")(rates=scenario.rates, **scenario.plant.parameters)
    body = plant._pair.body.parameters
    assert (body.height, body.mass) == (
        person.plant["body"]["height"],
        person.plant["body"]["mass"],
    )
    assert plant._gait.enabled
    assert plant._gait._half[1] == person.plant["gait"]["lateral"] / 2.0
    plant.close()


def test_what_is_drawn_follows_the_distributions_and_the_weights(example):
    people = example().draw(1500, seed=2)
    steady = [person.human for person in people if person.human.name == "steady"]
    assert len(steady) / len(people) == pytest.approx(0.75, abs=0.04)
    gain = [human.parameters["gain"] for human in steady]
    cut = stats.truncnorm(-2.0, 2.0, loc=2.0, scale=0.5)
    assert stats.kstest(gain, cut.cdf).pvalue > 0.001
    level = [human.parameters["level"][0] for human in steady]
    assert stats.kstest(level, stats.beta(2, 3).cdf).pvalue > 0.001
    gait = [len(human.imperfections) == 2 for human in steady]
    assert np.mean(gait) == pytest.approx(0.25, abs=0.05)


@pytest.mark.parametrize("name", SHIPPED)
def test_traits_go_together_as_stated(shipped, name):
    for traits in shipped[name].people:
        rng = np.random.default_rng(1)
        drawn = [traits.draw(rng) for _ in range(2000)]
        stated = {each.between: each.correlation for each in traits.correlations}
        assert {("body.height", "body.mass"), STRENGTHS} <= set(stated)
        for pair, correlation in stated.items():
            steps = [key.split(".") for key in pair]
            one, other = ([person[section][key] for person in drawn] for section, key in steps)
            # Of ranks, for a copula: that of the normal scores is 2 sin(pi rho_S/6).
            found = 2.0 * np.sin(np.pi * stats.spearmanr(one, other).statistic / 6.0)
            assert found == pytest.approx(correlation, abs=0.06)
        free = [drawn_["gait"]["lateral"] for drawn_ in drawn]
        tall = [drawn_["body"]["height"] for drawn_ in drawn]
        assert abs(stats.spearmanr(free, tall).statistic) < 0.06


STRENGTHS = ("strength.forward", "strength.sideways")


def test_people_are_as_tall_and_heavy_as_was_measured(shipped):
    men, women = shipped["healthy-adults"].people
    # ANSUR II: mean and standard deviation of height in m, mean of mass in kg.
    for traits, height, spread, mass in ((men, 1.756, 0.069, 85.5), (women, 1.628, 0.064, 67.8)):
        rng = np.random.default_rng(1)
        drawn = [traits.draw(rng)["body"] for _ in range(1500)]
        heights = [body["height"] for body in drawn]
        assert np.mean(heights) == pytest.approx(height, abs=0.006)
        assert np.std(heights) == pytest.approx(spread, abs=0.005)
        assert np.mean([body["mass"] for body in drawn]) == pytest.approx(mass, abs=1.2)


def test_the_frail_are_shorter_weaker_and_step_more_slowly(shipped):
    def means(name):
        people = shipped[name].draw(150, seed=5, plant="unicycle")
        return np.mean(
            [
                [
                    person.plant["body"]["height"],
                    *person.human.parameters["force_max"],
                    person.human.imperfections[-1].parameters["step_frequency"],
                    person.human.intention.pace,
                ]
                for person in people
            ],
            axis=0,
        )

    frail, healthy = means("frail-and-slow"), means("healthy-adults")
    assert (frail < (0.98, 0.75, 0.75, 0.9, 0.7) * healthy).all()


def test_one_person_is_strong_both_ways(shipped):
    people = shipped["uncertain"].draw(300, seed=1)
    forward, sideways = np.transpose([person.human.parameters["force_max"] for person in people])
    assert np.corrcoef(forward, sideways)[0, 1] > 0.75
    assert np.std(forward) > 1.0


def test_what_a_scenario_fixes_stays_and_what_a_person_has_wins(shipped):
    (person,) = shipped["healthy-adults"].draw(1, plant="bullet")
    carry = load("carry", ["human.intention.changes=[{at_time: 5.0, pace: 0.4}]"])
    chosen = with_person(carry, person)
    parameters = chosen.plant.parameters
    assert parameters["body"] == person.plant["body"] | {"hand": "both"}
    assert parameters["coupling"] == carry.plant.parameters["coupling"]
    assert parameters["walker"] == person.plant["walker"]
    assert chosen.human.intention.changes == carry.human.intention.changes
    assert chosen.human.intention.pace == person.human.intention.pace
    assert carry.plant.parameters["body"] == {"hand": "both"}
    assert with_person(load("paper-open-loop"), person).plant.parameters == {}
    with pytest.raises(InputError, match="person = 'ann': a Person"):
        with_person(carry, "ann")


def test_a_file_that_says_nothing_of_bodies_leaves_the_scenarios(example):
    for person in example().draw(3, plant="bullet"):
        assert person.plant == {}
        scenario = load("carry")
        assert with_person(scenario, person).plant == scenario.plant


BODIES = """\
name: example
people:
  - kind: all
    body:
      height: {distribution: norm, loc: 1.7, scale: 0.1, within: [1.5, 1.9]}
      mass: {distribution: norm, loc: 70.0, scale: 9.0, within: [50, 100]}
    gait: {enabled: true, step_frequency: {distribution: uniform, loc: 1.6, scale: 0.5}}
    strength: {forward: 8.0}
    correlations:
      - {between: [body.height, body.mass], correlation: 0.9}
      - {between: [body.height, gait.step_frequency], correlation: -0.3}
groups:
  - human: steady
  - human: {name: steady, parameters: {force_max: [3.0, 3.0]}}
"""


def test_a_group_that_says_how_strong_it_is_stays_so(example):
    forces = [tuple(p.human.parameters["force_max"]) for p in example(BODIES).draw(40)]
    assert set(forces) == {(8.0, 7.5), (3.0, 3.0)}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("height:", "heigth:", r":5: people.0.body.heigth: unknown key; did you mean 'height'"),
        ("  mass: {d", "  mass: {x: 1, d", r":6: .*x is no parameter of norm"),
        ("within: [1.5,", "within: [0.5,", r":5: .*height = 0.5.*must lie between 1.2 and 2.2"),
        ("body:", "bodys:", r":4: people.0.bodys: unknown key; did you mean 'body'"),
        ("strength: {forward: 8.0", "strength: {forward: -8.0", r"strength.forward = -8.0"),
        ("strength:", "arm:", r"people.0.arm.forward: unknown key"),
        ("gait: {", "gait: {swing: 2, ", r"people.0.gait.swing: unknown key"),
        ("    gait:", "    body2:", r"body2: unknown key"),
        ("correlation: 0.9", "correlation: 1.9", r":10: .*correlation = 1.9: it must be at most 1"),
        ("0.9}", "0.9, p: 1}", r"correlations.0.p: unknown key"),
        ("body.mass]", "body.mas]", r":10: .*'body.mas' is no distribution here; did you mean"),
        ("body.mass]", "body.height]", r":10: .*two different ones are expected"),
        ("gait.step_frequency], corr", "body.mass], corr", r":11: .*two are given twice"),
        (
            "-0.3}",
            "1.0}\n      - {between: [body.mass, gait.step_frequency], correlation: -0.9}",
            r":9: people.0.correlations: no numbers can be correlated like this",
        ),
        ("body:\n", "body:\n      hand: left\n", r":5: .*hand holds on is the scenario's"),
        (
            "  - human: steady",
            "  - human: {name: steady, imperfections: [gait-ripple]}",
            r":13: .*imperfections.0 = 'gait-ripple': people have a gait of their own",
        ),
    ],
)
def test_a_faulty_body_gets_one_line_with_its_place(example, old, new, message):
    assert old in BODIES
    with pytest.raises(InputError, match=message) as caught:
        example(BODIES.replace(old, new, 1))
    assert "\n" not in str(caught.value)


def test_a_recording_lies_beside_the_population(tmp_path, monkeypatch):
    file = tmp_path / "there" / "one.population.yaml"
    file.parent.mkdir()
    (file.parent / "push.csv").write_text("t_s,fx_n,fy_n\n0.0,0,0\n0.05,1,0\n0.1,0,0\n0.15,0,0\n")
    file.write_text(
        "name: one\ngroups: [{human: {name: recorded, parameters: {file: push.csv}}}]\n"
    )
    monkeypatch.chdir(tmp_path)
    (person,) = load_population("there/one.population.yaml").draw(1)
    assert Path(person.human.parameters["file"]) == file.parent / "push.csv"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("gain:", "gian:", r":7: .*gian: unknown key; did you mean 'gain'"),
        ("norm, loc", "nrom, loc", r":7: .*'nrom' is no distribution.*did you mean 'norm'"),
        (", within: [1.0, 3.0]", "", r"norm has no end; give within: \[LOW, HIGH\]"),
        ("within: [1.0,", "within: [-1.0,", r":7: .*gain = -1.0: must lie between"),
        ("a: 2,", "a: 0,", r"beta cannot have .*'a': 0"),
        ("a: 2,", "alpha: 2,", r"alpha is no parameter of beta"),
        ("b: 3", "b: three", r"b = 'three': a number is expected"),
        ("0.25", "1.25", r":11: .*probability = 1.25: must lie in \[0, 1\]"),
        ("- tremor", "- tremro", r"unknown imperfection 'tremro'; did you mean 'tremor'"),
        ("weight: 3", "weight: 0", r":3: groups.0.weight = 0"),
        ("groups:", "group:", r"groups is missing"),
        ("name: steady", "name: {distribution: norm}", r":5: .*human.name: a name is no number"),
        ("human: escalating", "human: {distribution: norm}", r"human: a name is no number"),
        ("escalating", "escalatign", r"unknown human 'escalatign'"),
    ],
)
def test_a_faulty_file_gets_one_line_with_its_place(example, old, new, message):
    with pytest.raises(InputError, match=message) as caught:
        example(EXAMPLE.replace(old, new, 1))
    assert "\n" not in str(caught.value)


def test_a_population_may_write_numbers_with_exponents(example):
    population = example(EXAMPLE.replace("weight: 3", "weight: 3e0"))
    assert population.groups[0].weight == 3.0


def test_a_fault_in_the_only_group_is_the_only_fault(example):
    text = "name: one\ngroups:\n  - weight: 0\n    human: {name: steady}\n"
    with pytest.raises(InputError) as caught:
        example(text)
    assert str(caught.value).endswith(":3: groups.0.weight = 0: it must be above 0")
    with pytest.raises(InputError, match=r"groups.*the list has 0 entries, it needs 1$"):
        example("name: none\ngroups: []\n")


def test_an_unknown_population_is_told_the_known_ones():
    with pytest.raises(InputError, match="did you mean 'determined'"):
        load_population("determinde")


def test_a_discrete_distribution_gives_whole_numbers():
    law = Distribution.model_validate({"distribution": "randint", "low": 1, "high": 4})
    drawn = [law.at(share) for share in (0.0, 0.2, 0.5, 0.9, 1.0 - 1e-12)]
    assert drawn == [1, 1, 2, 3, 3]
    assert all(isinstance(value, int) for value in drawn)
    assert law.ends == (1, 3)


def test_the_population_in_the_documents_loads_as_printed(example):
    page = (Path(__file__).parents[3] / "docs" / "humans.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"```yaml\n(name: .*?groups:.*?)```", page, re.DOTALL)
    people = example(text).draw(20)
    assert {person.human.name for person in people} == {"steady", "escalating"}
    assert {person.kind for person in people} == {"adults"}
