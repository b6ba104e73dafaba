"""What the documents say can be followed: links lead somewhere, shown Python runs."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files_that_exist(page):
    for target in re.findall(r"\]\(([^)#]+?)(?:#[^)]*)?\)", page.read_text()):
        if "://" not in target:
            assert (page.parent / target).exists(), target


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
