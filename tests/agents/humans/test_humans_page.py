"""What docs/humans.md shows is what the code takes."""

import re
import shutil
from pathlib import Path

import pytest
import yaml

from cowalk.agents import HUMANS
from cowalk.scenarios.files.loading import find, load

PAGE = (Path(__file__).parents[3] / "docs" / "humans.md").read_text(encoding="utf-8")
EXAMPLES = [
    example
    for text in re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    if set(example := yaml.safe_load(text)) == {"human"}
]


def test_every_model_is_explained():
    for name in HUMANS:
        assert f"| `{name}` |" in PAGE, name


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example["human"]["name"])
def test_examples_load_as_printed(example, tmp_path, stand_in_recording, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copy(stand_in_recording, "recording.csv")
    force = ",".join(f"/wrench/force/{axis}" for axis in "xyz")
    rows = "".join(f"/wrench,{n % 7},{n % 5},-9.5\n/velocity,0.8,0,0\n" for n in range(900))
    Path("log.csv").write_text(f"topic,{force}\n{rows}", encoding="utf-8")
    scenario = yaml.safe_load(find("puddle").read_text(encoding="utf-8"))
    file = tmp_path / "example.scenario.yaml"
    file.write_text(yaml.safe_dump(scenario | example), encoding="utf-8")
    assert load(str(file)).human.name == example["human"]["name"]


def test_there_are_examples():
    assert len(EXAMPLES) >= 2
