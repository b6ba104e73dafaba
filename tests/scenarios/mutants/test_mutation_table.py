"""Six automations that are bad in a known way: every metric must say what was stated of it."""

import json

import numpy as np
import pytest

from cowalk.agents import check_automation
from cowalk.agents.registry import AUTOMATIONS
from cowalk.scenarios import load
from cowalk.scenarios.measures.definitions import definitions
from cowalk.scenarios.mutants import study, table
from cowalk.scenarios.mutants.automations import MUTANTS
from cowalk.scenarios.mutants.statement import statements

PLANTS = {
    "bullet": (4, "plant.parameters.gait.enabled=true"),
    "unicycle": (6, "plant=unicycle"),
}
"""How many people walk, and what is changed of the scenario."""


@pytest.fixture(scope="session")
def found():
    """Everything once: what each metric is on each plant, by automation."""
    return {
        plant: study.mutate(load("puddle", changes), people, jobs=1)
        for plant, (people, *changes) in PLANTS.items()
    }


@pytest.fixture(params=PLANTS)
def verdicts(request, found):
    return study.judge(found[request.param], request.param)


def test_every_metric_says_what_was_stated_of_it(verdicts):
    assert {verdict.metric: verdict.wrong for verdict in verdicts if verdict.wrong} == {}


def test_each_bad_automation_is_the_worst_of_some_metric(verdicts):
    worst = {name for verdict in verdicts for name in verdict.worst}
    assert worst == set(MUTANTS)


def test_lying_improves_nothing_and_changes_nothing_that_was_done(found):
    for values in found.values():
        paper, lies = values[study.HONEST], values["lies"]
        said = {name for name in definitions() if name.startswith(("stubb", "smoothed", "wish"))}
        for name in definitions().keys() - said:
            np.testing.assert_array_equal(paper[name], lies[name], err_msg=name)
        assert said


def test_a_statement_is_made_of_every_metric_with_a_direction_and_of_no_other():
    scored = {name for name, definition in definitions().items() if definition.worse}
    for plant in PLANTS:
        assert set(statements(plant)) == scored
        named = {
            name
            for each in statements(plant).values()
            for name in (each.worst, *each.blind)
            if name
        }
        assert named <= set(MUTANTS)
        assert {each.worst for each in statements(plant).values()} >= set(MUTANTS)


def test_a_wrong_statement_is_seen(found, monkeypatch):
    claimed = study.Statement("late", ("parked",))
    monkeypatch.setattr(study, "statements", lambda plant: dict.fromkeys(definitions(), claimed))
    wrong = {each.metric: each.wrong for each in study.judge(found["bullet"], "bullet")}
    assert wrong["progress"] == ("worst: parked", "sees parked")


def test_lying_that_pays_is_seen(found):
    values = {name: dict(each) for name, each in found["bullet"].items()}
    values["lies"]["path error"] = values["lies"]["path error"] * 0.5
    values["lies"]["time apart, v"] = np.full(5, np.nan)
    wrong = {each.metric: each.wrong for each in study.judge(values, "bullet")}
    assert wrong["path error"] == wrong["time apart, v"] == ("lying improves it",)


@pytest.mark.parametrize("name", MUTANTS.values())
def test_a_bad_automation_is_an_automation(name):
    check_automation(AUTOMATIONS.get(name))


def test_the_command_prints_the_table_writes_it_and_gives_it_as_json(
    cowalk, tmp_path, monkeypatch, found
):
    monkeypatch.setattr(study, "mutate", lambda *_, **__: found["unicycle"])
    file = tmp_path / "metrics.md"
    file.write_text(f"<!-- {table.MARK} -->\nold\n<!-- /{table.MARK} -->\n")
    command = ("mutants", "metrics", "--plant", "unicycle")
    code, out, _ = cowalk(*command, "--write", file)
    assert code == 0
    assert "never yields" in out
    text = file.read_text()
    assert "old" not in text
    assert "| progress " in text
    assert text.count("\n| ") > 2 * len(definitions()) - 20
    code, out, _ = cowalk(*command, "--json")
    assert code == 0
    metrics = json.loads(out)["metrics"]
    assert {each["metric"] for each in metrics} == statements("unicycle").keys()
    assert all(each["stated"].keys() == {"worst", "blind"} for each in metrics)


def test_the_command_fails_where_a_metric_says_something_else(cowalk, monkeypatch, found):
    swapped = dict(found["unicycle"])
    swapped["parked"], swapped["late"] = swapped["late"], swapped["parked"]
    monkeypatch.setattr(study, "mutate", lambda *_, **__: swapped)
    code, out, _ = cowalk("mutants", "metrics", "--plant", "unicycle")
    assert code == 1
    assert "worst: late" in out


def test_a_document_without_a_place_is_refused_before_anything_runs(cowalk, tmp_path):
    file = tmp_path / "metrics.md"
    file.write_text("nothing")
    code, _, error = cowalk("mutants", "metrics", "--write", file)
    assert code == 2
    assert "no place for the table" in error
