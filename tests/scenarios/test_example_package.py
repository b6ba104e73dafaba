"""The package in docs/examples, as written: installed, found by name, checked and run."""

import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[2] / "docs" / "examples" / "hesitant-human"


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Return a folder on the path as an installer leaves it: the module and its metadata.

    The entry points are those of the example's own pyproject.toml; no build tool is needed.
    """
    folder = tmp_path_factory.mktemp("site")
    project = tomllib.loads((EXAMPLE / "pyproject.toml").read_text())
    for module in project["tool"]["setuptools"]["py-modules"]:
        shutil.copy(EXAMPLE / f"{module}.py", folder)
    name, version = project["project"]["name"], project["project"]["version"]
    info = folder / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
    lines = []
    for group, points in project["project"]["entry-points"].items():
        lines += [f"[{group}]", *(f"{key} = {value}" for key, value in points.items())]
    (info / "entry_points.txt").write_text("\n".join(lines) + "\n")
    return folder


def call(folder, *arguments):
    environment = os.environ | {"PYTHONPATH": str(folder)}
    return subprocess.run(
        [sys.executable, "-W", "error", "-m", *arguments],
        capture_output=True,
        text=True,
        env=environment,
        cwd=folder,
        check=False,
    )


def test_the_module_takes_less_than_thirty_lines():
    text = (EXAMPLE / "hesitant_human.py").read_text()
    assert len(text.splitlines()) < 30


def test_the_documents_show_the_package_as_it_is():
    page = (EXAMPLE.parents[1] / "write-your-own.md").read_text(encoding="utf-8")
    assert f"```python\n{(EXAMPLE / 'hesitant_human.py').read_text()}```" in page
    points = (EXAMPLE / "pyproject.toml").read_text().partition("[project.entry-points")[2]
    assert f"[project.entry-points{points.partition('[tool')[0].rstrip()}\n```" in page


def test_the_new_human_is_found_by_name_and_runs_in_a_scenario(installed):
    program = (
        "from cowalk.agents import HUMANS, check_human\n"
        "from cowalk.scenarios import load, run\n"
        "check_human(HUMANS.get('hesitant'))\n"
        "swap = ['plant=unicycle', 'human=hesitant', 'duration=12']\n"
        "swap += ['human.parameters.patience=0.5']\n"
        "result = run(load('puddle', swap))\n"
        "assert result.error is None, result.error\n"
        "assert result.summary['human'] == 'hesitant'\n"
        "print(len(result.trace))\n"
    )
    (installed / "try_it.py").write_text(program)
    done = call(installed, "try_it")
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "240"
