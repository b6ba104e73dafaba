"""What cowalk new writes is right as it stands, and nothing is written over."""

import re
import sys

import pytest

from cowalk.scenarios.cli.new import SCENARIO, camel_case, startable

PARTS = [kind for kind in startable() if kind != SCENARIO]
QUICK = ("--plant", "unicycle", "--no-figure")
DROPPED = "cowalk: plant is now 'unicycle': dropped what was said of 'bullet'"


@pytest.fixture
def here(tmp_path, monkeypatch):
    """An empty working folder."""
    monkeypatch.chdir(tmp_path)
    before = set(sys.modules)
    yield tmp_path
    for name in set(sys.modules) - before:
        if name.startswith("started_"):
            sys.modules.pop(name)


def test_there_is_a_start_for_every_kind_that_is_checked_and_for_a_scenario():
    assert startable() == ["human", "automation", "front-end", "smoother", "observer", "scenario"]


@pytest.mark.parametrize("kind", PARTS)
def test_a_start_passes_its_check_and_the_commands_that_are_named_work(kind, cowalk, here):
    name = f"started_{kind.replace('-', '_')}"
    code, out, error = cowalk("new", kind, name)
    assert (code, error) == (0, "")
    assert f"class {camel_case(name)}" in (here / f"{name}.py").read_text()
    said, *commands = out.splitlines()
    assert said == f"wrote {name}.py, {kind} {camel_case(name)}; next:"
    check, run, compare = (command.split()[1:] for command in commands)
    word = kind.replace("-", " ")
    assert cowalk(*check) == (0, f"{check[1]}: no fault ({word})\n", "")
    code, out, error = cowalk(*run, *QUICK, "--set", "expect={}", "--json")
    assert code == 0
    swaps = "cowalk: human is now 'started_human:StartedHuman': drop", DROPPED
    assert all(line.startswith(swaps) for line in error.splitlines())
    assert f'"{word.replace(" ", "_")}": "{check[1]}"' in out
    quick = ("--plant", "unicycle", "--set", "duration=4", "-n", "2")
    code, out, error = cowalk(*compare, *quick)
    assert code == 0
    told = "cowalk: walking: ", f"{DROPPED}: gait, walker"
    assert all(line.startswith(told) for line in error.splitlines())
    assert check[1] in out


def test_a_scenario_holds_and_is_a_test(cowalk, pytester):
    code, out, error = cowalk("new", "scenario", "my-corridor")
    assert (code, error) == (0, "")
    check, run, compare = (line.split()[1:] for line in out.splitlines()[1:])
    assert cowalk(*check) == (0, "my-corridor.scenario.yaml: no fault\n", "")
    code, out, error = cowalk(*run, "--no-figure")
    assert (code, error) == (0, "")
    assert "ended by: goal" in out
    code, out, error = cowalk(*compare, "-n", "2", "--set", "duration=4")
    assert code == 0
    assert all(line.startswith("cowalk: walking: ") for line in error.splitlines())
    pytester.runpytest_subprocess().assert_outcomes(passed=5)


def test_a_file_that_is_there_stays(cowalk, here):
    (here / "mine.py").write_text("kept")
    code, out, error = cowalk("new", "human", "mine")
    assert (code, out) == (2, "")
    assert error == "cowalk: mine.py is there already: give another name\n"
    assert (here / "mine.py").read_text() == "kept"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("human", "my-human"), "'my-human' is no name of a Python module; 'my_human' would be"),
        (("human", "../other"), "'../other' is no name of a Python module; 'other' would be"),
        (("human", "class"), "'class' is no name of a Python module; 'hasty_human' would be"),
        (("human", "_"), "'_' is no name of a Python module; 'hasty_human' would be"),
        (("smoother", "numpy"), "'numpy' is a module that is installed: give another name"),
        (("scenario", "a/b"), "'a/b' is no name of a scenario: letters, digits, _ and - make one"),
        (("scenario", ""), "'' is no name of a scenario: letters, digits, _ and - make one"),
        (("humam", "x"), "unknown kind 'humam'; did you mean 'human'? Known: human, automation"),
    ],
)
def test_other_names_are_refused_in_one_line(arguments, said, cowalk, here):
    code, out, error = cowalk("new", *arguments)
    assert (code, out) == (2, "")
    assert re.match(re.escape(f"cowalk: {said}"), error)
    assert error.count("\n") == 1
    assert not list(here.iterdir())


def test_a_folder_that_cannot_be_written_is_said(cowalk, here, monkeypatch):
    (here / "gone").mkdir()
    monkeypatch.chdir(here / "gone")
    (here / "gone").rmdir()
    code, _, error = cowalk("new", "scenario", "mine")
    assert code == 2
    assert "mine.scenario.yaml: cannot be written (No such file or directory)" in error
