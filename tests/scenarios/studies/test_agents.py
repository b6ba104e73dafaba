"""Humans and automations in the loop, scored by what walking together costs."""

from cowalk.agents import AUTOMATIONS, HUMANS
from cowalk.scenarios import load
from cowalk.scenarios.studies.agents import compare_agents

QUICK = ("plant=unicycle", "duration=12")


def test_every_automation_is_scored_the_scenarios_first():
    scores = compare_agents(load("puddle", QUICK), seeds=2, jobs=1)
    assert [score.name for score in scores] == ["stubbornness", "always-yields", "never-yields"]
    assert {score.name for score in scores} == set(AUTOMATIONS)
    by_name = {score.name: score for score in scores}
    assert by_name["never-yields"].lowest_target_utility == 1.0
    assert by_name["always-yields"].lowest_target_utility == 0.0
    for score in scores:
        assert score.effort > score.mean_force > 0.0
        assert score.agreed <= score.runs == 2
        assert score.reached_goal == 0  # 12 s are too short


def test_humans_that_need_parameters_are_left_out_unless_the_scenario_gives_them():
    scores = compare_agents(load("puddle", (*QUICK, "duration=4")), "human", seeds=1, jobs=1)
    names = [score.name for score in scores]
    assert names[0] == "escalating"
    assert set(HUMANS) - set(names) == {"recorded"}
    forces = {score.name: score.mean_force for score in scores}
    assert forces["open-loop"] < 0.05, "it pushes nothing: this is the sensor's noise"
    assert forces["steady"] > 0.1
