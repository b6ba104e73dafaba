"""Humans and automations in the loop, scored by what walking together costs."""

import numpy as np
import pytest

from cowalk.agents import AUTOMATIONS, HUMANS
from cowalk.scenarios import load
from cowalk.scenarios.people.loading import load_population
from cowalk.scenarios.studies.agents import compare_agents
from cowalk.scenarios.studies.places import places
from cowalk.sim.basics.errors import InputError

QUICK = ("plant=unicycle", "duration=9")


@pytest.fixture(scope="module")
def healthy():
    return load_population("healthy-adults")


def test_every_automation_is_scored_the_scenarios_first(healthy):
    scores = compare_agents(load("puddle", QUICK), "automation", [], healthy, 2, jobs=1)
    assert [score.name for score in scores] == ["stubbornness", "always-yields", "never-yields"]
    assert {score.name for score in scores} == set(AUTOMATIONS)
    by_name = {score.name: score for score in scores}
    assert by_name["never-yields"].concession == pytest.approx(0.0, abs=1e-9)
    assert by_name["never-yields"].resolved_in_time == 0.0
    assert by_name["always-yields"].concession > by_name["stubbornness"].concession
    for score in scores:
        assert score.effort > 5.0 * score.effort_a_metre > 0.0
        assert score.runs == 6
        assert score.reached_goal == 0  # 9 s are too short


def test_those_runs_pass_that_meet_the_expectations_of_the_scenario(healthy):
    expect = {"they give way": "eventually (abs(target_utility - 1.0) >= 0.05)"}
    own = expect | {"only one part traces it": "always (mood >= 0.0)"}
    scenario = load("puddle", QUICK).model_copy(update={"expect": expect})
    scores = compare_agents(scenario, "automation", [], healthy, 2, jobs=1)
    passes = {score.name: score.passes for score in scores}
    assert passes["never-yields"] == 0
    assert passes["stubbornness"] == 6
    scenario = scenario.model_copy(update={"expect": own})
    scores = compare_agents(scenario, "automation", [], healthy, 2, jobs=1)
    assert all(score.passes == 0 for score in scores)


def test_humans_that_need_parameters_are_left_out_unless_the_scenario_gives_them(healthy):
    scenario = load("puddle", (*QUICK, "duration=4", "sensor.noise_density=0.0"))
    scores = compare_agents(scenario, "human", [], healthy, 2, jobs=1)
    names = [score.name for score in scores]
    assert names[0] == "escalating"
    assert set(HUMANS) - set(names) == {"recorded"}
    efforts = {score.name: score.effort for score in scores}
    # Who never pushes costs what the gait costs, and everybody else more.
    assert min(efforts, key=efforts.__getitem__) == "open-loop"
    assert efforts["steady"] > efforts["open-loop"] + 0.4


def test_people_walk_in_three_worlds_each_with_a_seed_of_its_own(healthy):
    walked = places(load("puddle"), healthy, 4)
    assert len(walked) == len({place.scenario.seed for place in walked}) == 12
    assert len({place.scenario.world.obstacles[0].x for place in walked}) == 12
    assert [place.name for place in walked[:4]] == ["person 1"] * 3 + ["person 2"]
    assert walked[0].person == walked[2].person != walked[3].person
    shifts = np.array([place.scenario.world.obstacles[0].y for place in walked]) + 1.05
    assert (np.abs(shifts) <= 0.3).all()
    with pytest.raises(InputError, match="people = 1"):
        places(load("puddle"), healthy, 1)
