"""docs/write-your-own.md, followed to the letter: its parts pass, its commands work."""

import re
import sys
from pathlib import Path

import pytest

from cowalk.scenarios import load, run
from cowalk.scenarios.files.own_parts import judge_own_part

PAGE = (Path(__file__).parents[2] / "docs" / "write-your-own.md").read_text(encoding="utf-8")
CLASSES = {
    "HesitantHuman": "human",
    "Deadline": "automation",
    "BlockMedian": "front end",
    "Persistence": "observer",
    "RunningMedian": "smoother",
}


@pytest.fixture
def my_parts(tmp_path, monkeypatch):
    """A working folder with the page's file of five parts."""
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "my_parts.py").write_text("\n".join(blocks))
    yield tmp_path
    for name in ("my_parts", "my_observer"):
        sys.modules.pop(name, None)


def commands():
    blocks = re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL)
    return [line.partition("  #")[0].strip() for block in blocks for line in block.splitlines()]


def test_there_is_an_example_of_each_kind_and_each_passes_its_check(my_parts):
    assert set(re.findall(r"^class (\w+)", PAGE, re.MULTILINE)) == set(CLASSES)
    for name, kind in CLASSES.items():
        assert judge_own_part(f"my_parts:{name}") == (kind, [])


def test_estimators_and_strategy_work_together_and_add_columns(my_parts):
    swaps = {
        "automation": "Deadline",
        "automation.front_end": "BlockMedian",
        "automation.observer": "Persistence",
        "automation.smoother": "RunningMedian",
    }
    result = run(load("puddle", [f"{key}=my_parts:{name}" for key, name in swaps.items()]))
    assert result.error is None
    assert result.trace.units["overruled"] == "1"
    assert result.trace.units["pushing"] == "s"
    assert 0.0 <= result.trace["overruled"].max() <= 1.0
    assert result.trace["pushing"].max() > 0.0


def test_the_commands_that_the_page_shows_work(my_parts, cowalk):
    shown = commands()
    assert {line.split()[1] for line in shown} == {"new", "check", "run", "compare"}
    for line in shown:
        _, command, *arguments = line.split()
        if command == "compare":  # few and short ones: this is about the words
            arguments += ["-n", "2", "--set", "duration=4", "--set", "plant=unicycle"]
            arguments = [each for each in arguments if each not in ("--plant", "unicycle")]
        code, _, error = cowalk(command, *arguments, *["--no-figure"] * (command == "run"))
        assert code == 0 or (command, code) == ("run", 1), (line, error)


def test_every_kind_that_can_be_begun_is_in_the_pages_table():
    from cowalk.scenarios.cli.new import startable

    rows = re.findall(r"^\| `([\w-]+)` \|", PAGE, re.MULTILINE)
    assert sorted(rows) == sorted(startable())
