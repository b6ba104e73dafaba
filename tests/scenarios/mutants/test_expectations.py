"""What the shipped scenarios expect, with parts that are bad on purpose: it tells them apart."""

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

from cowalk.agents import HUMANS, check_human
from cowalk.scenarios import load, run
from cowalk.scenarios.files.schema import with_named
from cowalk.scenarios.files.shipped import scenario_library
from cowalk.scenarios.mutants import trial_table, trials
from cowalk.scenarios.mutants.automations import Parked
from cowalk.scenarios.mutants.humans import WRONG_HUMANS, LetsGo, SeesNothing, TwiceAsStrong

DOCUMENT = Path(__file__).parents[3] / "docs" / "expectations.md"


class ParkedThatReportsConcession(Parked):
    """Stands still, and reports that it gives up half of its utility."""

    def belief(self):
        return dataclasses.replace(super().belief(), target_utility=0.5)


@pytest.fixture(scope="session")
def examined():
    """Everything once, by scenario."""
    scenarios = [load(name) for name in scenario_library()]
    return {each.scenario: each for each in trials.examine(scenarios, jobs=2)}


@pytest.fixture(params=scenario_library())
def one(request, examined):
    return examined[request.param]


def trial(examined, part):
    return next(each for each in examined.trials if each.part == part)


def test_all_hold_as_it_is_each_fails_with_something_bad_and_parked_never_passes(one):
    assert one.faults == ()
    assert not all(trial(one, "parked").held.values())


def test_who_never_yields_fails_wherever_somebody_asks_for_something(one):
    assert all(trial(one, "never yields").held.values()) == (one.scenario == "walk")


def test_who_lies_is_judged_by_what_it_does(one):
    assert trial(one, "lies") == dataclasses.replace(trial(one, trials.SHIPPED), part="lies")


def test_a_wrong_human_makes_a_difference_except_where_the_scenario_has_none_of_it(one):
    same = {name for name in WRONG_HUMANS if trial(one, name).same}
    # They let go as it is, in an empty corridor; a prescribed force looks at nothing.
    without = {"walk": set(WRONG_HUMANS), "paper-open-loop": {"sees nothing"}}
    assert same == without.get(one.scenario, set())


def test_who_has_no_wish_fails_wherever_there_is_one(one):
    assert all(trial(one, "no wish").held.values()) == (one.scenario == "walk")


@pytest.mark.parametrize("name", scenario_library())
def test_reporting_a_concession_helps_no_parked_robot(name, examined):
    scenario = load(name)
    parked = trials.with_bad_part(scenario, "parked").automation
    liar = f"{__name__}:{ParkedThatReportsConcession.__name__}"
    scenario = with_named(scenario, "automation", liar)
    kept = scenario.automation.model_copy(update={"parameters": parked.parameters})
    result = run(scenario.model_copy(update={"automation": kept}))
    held = {verdict.name: verdict.passed for verdict in result.verdicts}
    assert held == trial(examined[name], "parked").held
    assert np.nanmin(result.trace["target_utility"]) == 0.5


def test_the_page_shows_what_the_command_finds(examined):
    table = trial_table.markdown(list(examined.values()))
    text = DOCUMENT.read_text(encoding="utf-8")
    assert f"<!-- {trial_table.MARK} -->\n{table}\n<!-- /" in text


def made(**held):
    """Return two expectations with every part; what is not given holds."""
    named = {part: held.get(part.replace(" ", "_"), (True, True)) for part in trials.PARTS}
    each = [
        trials.Trial(part, dict(zip(("a", "b"), values, strict=True)), "goal", False)
        for part, values in named.items()
    ]
    return trials.Examined("made", {"a": "x >= 0", "b": "y >= 0"}, tuple(each))


def test_expectations_that_do_not_discriminate_are_told():
    assert made(parked=(False, True), late=(True, False)).faults == ()
    assert made(late=(True, False)).faults == (
        "'a' fails with no bad part",
        "a parked robot meets all of them",
    )
    failed = made(parked=(True, False), as_it_is=(False, True))
    assert failed.faults == ("'a' fails as it is", "'a' fails with no bad part")


@pytest.mark.parametrize("wrong", [LetsGo, TwiceAsStrong, SeesNothing])
def test_a_wrong_human_is_a_human(wrong):
    check_human(wrong(HUMANS.get("steady")()))


def test_who_is_twice_as_strong_pushes_twice_and_who_lets_go_not_at_all():
    plain = load("paper-open-loop", ["duration=20"])
    traces = {part: run(trials.with_bad_part(plain, part)).trace for part in trials.PARTS[-3:]}
    own = run(plain).trace
    np.testing.assert_array_equal(traces["double strength"]["fy_intent"], 2.0 * own["fy_intent"])
    # Of a person who is as strong as that, it is the same share.
    shares = [trace["true_insistence_omega"] for trace in (traces["double strength"], own)]
    np.testing.assert_array_equal(*shares)
    assert not traces["no wish"]["fy_intent"].any()
    assert own["fy_intent"].max() == 4.0


def test_a_wrong_human_keeps_imperfections_and_a_bad_automation_what_it_knows():
    scenario = load("paper-open-loop", ["human.imperfections=[tremor]"])
    wrong = trials.with_bad_part(scenario, "sees nothing").human
    assert [each.name for each in wrong.imperfections] == [WRONG_HUMANS["sees nothing"], "tremor"]
    assert wrong.parameters == scenario.human.parameters
    late = trials.with_bad_part(scenario, "late").automation
    assert late.parameters == scenario.automation.parameters != {}
    assert late.negotiation == scenario.automation.negotiation
    assert trials.with_bad_part(scenario, "never yields").automation.parameters == {}
    assert trials.with_bad_part(scenario, trials.SHIPPED) == scenario


def test_the_command_prints_writes_and_gives_json(cowalk, tmp_path, monkeypatch, examined):
    monkeypatch.setattr(trials, "examine", lambda given, _: [examined[s.name] for s in given])
    file = tmp_path / "page.md"
    file.write_text(f"<!-- {trial_table.MARK} -->\nstale\n<!-- /{trial_table.MARK} -->\n")
    code, out, _ = cowalk("mutants", "expectations", "walk", "puddle", "--write", file)
    assert code == 0
    assert out.count("they arrive") == out.count("they walk on") == 1
    text = file.read_text()
    assert "stale" not in text
    assert text.index("**walk**") < text.index("**puddle**")
    code, out, _ = cowalk("mutants", "expectations", "--json")
    found = json.loads(out)["scenarios"]
    assert code == 0
    assert [each["scenario"] for each in found] == list(scenario_library())
    assert all(each["faults"] == [] for each in found)
    assert {each["part"] for each in found[0]["trials"]} == set(trials.PARTS)


def test_the_command_fails_where_a_parked_robot_passes(cowalk, monkeypatch):
    monkeypatch.setattr(trials, "examine", lambda *_: [made(late=(False, False))])
    code, out, _ = cowalk("mutants", "expectations", "walk")
    assert code == 1
    assert "made: a parked robot meets all of them" in out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("walk", "--set", "expect={}"), "walk: expect: this scenario expects nothing"),
        (("no-such",), "no-such"),
        (("walk", "--write", "nowhere.md"), "nowhere.md: cannot be read"),
    ],
)
def test_what_cannot_be_examined_is_refused(cowalk, arguments, said):
    code, _, error = cowalk("mutants", "expectations", *arguments)
    assert code == 2
    assert said in error
    assert error.count("\n") == 1
