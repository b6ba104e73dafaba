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
from cowalk.scenarios.people.population import load_population, population_library
from cowalk.scenarios.running.runner import run
from cowalk.sim.basics.errors import InputError

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
        if KEY in value or "human" in value:
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


@pytest.mark.parametrize("name", SHIPPED)
def test_a_drawn_human_builds_keeps_the_protocol_and_runs(shipped, name):
    for plant in ("unicycle", "bullet"):
        for person in shipped[name].draw(3, seed=11, plant=plant):
            assert human_problems(build_human(person, plant, 0.05)) == []
    scenario = load("puddle", [f"plant={plant}", "duration=2.0", "expect={}"])
    result = run(scenario.model_copy(update={"human": person}))
    assert result.error is None
    assert len(result.trace) == 40


@pytest.mark.parametrize("name", SHIPPED)
def test_a_draw_repeats_and_longer_draws_begin_alike(shipped, name):
    population = shipped[name]
    assert population.draw(12, seed=4) == population.draw(12, seed=4)
    assert population.draw(12, seed=4)[:5] == population.draw(5, seed=4)
    assert population.draw(5, seed=4) != population.draw(5, seed=5)


def test_gait_is_left_to_the_body_where_there_is_one(shipped):
    for plant, there in (("unicycle", True), ("bullet", False)):
        for person in shipped["healthy-adults"].draw(5, plant=plant):
            assert ("gait-ripple" in [item.name for item in person.imperfections]) is there


def test_what_is_drawn_follows_the_distributions_and_the_weights(example):
    people = example().draw(1500, seed=2)
    steady = [person for person in people if person.name == "steady"]
    assert len(steady) / len(people) == pytest.approx(0.75, abs=0.04)
    gain = [person.parameters["gain"] for person in steady]
    cut = stats.truncnorm(-2.0, 2.0, loc=2.0, scale=0.5)
    assert stats.kstest(gain, cut.cdf).pvalue > 0.001
    level = [person.parameters["level"][0] for person in steady]
    assert stats.kstest(level, stats.beta(2, 3).cdf).pvalue > 0.001
    gait = [len(person.imperfections) == 2 for person in steady]
    assert np.mean(gait) == pytest.approx(0.25, abs=0.05)


def test_the_measured_gait_is_that_of_the_healthy(shipped):
    people = shipped["healthy-adults"].draw(400, seed=1)
    gait = [item.parameters for person in people for item in person.imperfections][4::6]
    for name, published in {
        "step_frequency": (1.63, 1.82, 2.08),
        "lateral_sway": (0.027, 0.060, 0.115),
        "fore_aft_sway": (0.036, 0.066, 0.159),
    }.items():
        drawn = np.percentile([values[name] for values in gait], (5, 50, 95))
        np.testing.assert_allclose(drawn, published, rtol=0.12)  # 5 % of 400 people


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
    assert {person.name for person in example(text).draw(20)} == {"steady", "escalating"}
