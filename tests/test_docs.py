"""What the documents say can be followed: links lead somewhere, shown Python runs."""

import importlib.util
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
_SPEC = importlib.util.spec_from_file_location("build", ROOT / "docs" / "build.py")
build = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(build)
PARTS = ("sim", "estimation", "agents", "scenarios")
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
CURRENT = [page for page in PAGES if page.name != "CHANGELOG.md"]
"""Pages that speak of what is there; the list of changes also names what is gone."""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files_that_exist(page):
    for target in re.findall(r"\]\(([^)#]+?)(?:#[^)]*)?\)", page.read_text()):
        if "://" not in target:
            assert (page.parent / target).exists(), target


@pytest.mark.parametrize("page", CURRENT, ids=lambda page: str(page.relative_to(ROOT)))
def test_files_and_folders_that_a_page_names_are_there(page):
    tops = "|".join((*PARTS, "tests", "benchmarks", "docs"))
    named = re.findall(rf"`((?:{tops})/[\w/.-]*)`", page.read_text())
    assert not [name for name in named if not (ROOT / name).exists()]


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


def test_the_readmes_python_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (code,) = [block for block in python_of("README.md") if "make_env" in block]
    exec(compile(code, "README.md", "exec"), {})


def dotted_names():
    """Yield every full name of ours in pages and code, with the file that holds it."""
    code = [file for part in PARTS for file in (ROOT / part).rglob("*.py")]
    for file in [*CURRENT, *code]:
        for name in re.findall(rf"\bcowalk\.(?:{'|'.join(PARTS)})(?:\.\w+)+", file.read_text()):
            yield name, file.relative_to(ROOT)


def test_full_names_in_pages_and_code_lead_somewhere():
    lost = {name: str(file) for name, file in dotted_names() if not leads_somewhere(name)}
    assert not lost


@cache
def leads_somewhere(name):
    try:
        importlib.import_module(name)
    except ImportError:
        owner, _, last = name.rpartition(".")
        *_, part = owner.split(".")
        if part[:1].isupper():  # a member of a class
            module, _, part = owner.rpartition(".")
            return hasattr(getattr(importlib.import_module(module), part), last)
        return hasattr(importlib.import_module(owner), last)
    return True


def test_new_names_in_the_list_of_changes_lead_somewhere():
    rows = re.findall(
        r"^\| `(cowalk\S+)` \| `(cowalk\S+)` \|$", (ROOT / "CHANGELOG.md").read_text(), re.M
    )
    assert rows
    assert not [new for _, new in rows if not leads_somewhere(new)]
