"""What the documents say can be followed: links lead somewhere, shown Python runs."""

import importlib.util
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
_SPEC = importlib.util.spec_from_file_location("build", ROOT / "docs" / "build.py")
build = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(build)
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files_that_exist(page):
    for target in re.findall(r"\]\(([^)#]+?)(?:#[^)]*)?\)", page.read_text()):
        if "://" not in target:
            assert (page.parent / target).exists(), target


def quoted(page, name):
    text = (ROOT / page).read_text()
    (found,) = re.findall(rf"<!-- {name} -->\n(.*?)\n<!-- /{name} -->", text, re.DOTALL)
    return found


def test_the_readme_quotes_what_its_run_prints(tmp_path):
    def but_speed(text):
        return [line for line in text.splitlines() if not line.startswith("speed:")]

    printed = build.fenced(build.printed_by_run(str(tmp_path)))
    assert but_speed(quoted("README.md", "run")) == but_speed(printed)


def test_the_page_on_the_model_quotes_what_the_paper_command_prints():
    assert quoted("docs/model.md", "paper") == build.fenced(build.output("paper"))


def test_pages_quote_the_files_and_presets_that_ship():
    assert quoted("docs/scenarios.md", "puddle") == build.fenced(build.shipped("puddle"), "yaml")
    assert quoted("docs/world.md", "doorway") == build.fenced(build.shipped("doorway"), "yaml")
    assert quoted("docs/sensor.md", "presets") == build.preset_table()


def python_of(page):
    return re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.DOTALL)


def test_the_readmes_own_human_runs(tmp_path, monkeypatch):
    from cowalk.scenarios import load, run

    (code,) = [block for block in python_of("README.md") if "class Impatient" in block]
    (tmp_path / "mymodels.py").write_text(code)
    monkeypatch.syspath_prepend(tmp_path)
    result = run(load("puddle", ["human=mymodels:Impatient", "human.parameters.pace=1.1"]))
    assert result.error is None
    assert result.trace["true_v"].max() == 1.1


def test_the_readmes_python_runs():
    (code,) = [block for block in python_of("README.md") if "make_env" in block]
    exec(compile(code, "README.md", "exec"), {})
