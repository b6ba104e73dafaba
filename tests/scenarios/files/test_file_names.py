"""Files that a scenario names: relative to it where it names them, else to the working folder."""

import os
import sys
from pathlib import Path

import pytest
import yaml

from cowalk.scenarios.cli import main as cli
from cowalk.scenarios.files.loading import faults, load, read_document, to_yaml
from cowalk.scenarios.files.shipped import scenario_library
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.file_names import FileName, names_file

ROBOT = """<robot name="own"><link name="base"><inertial><mass value="30"/>
<inertia ixx="1" iyy="1" izz="1"/></inertial></link><link name="handle"/>
<joint name="bar" type="fixed"><parent link="base"/><child link="handle"/>
<origin xyz="-0.4 0 0.9"/></joint></robot>"""
ROWS = "t_s,fx_n,fy_n\n" + "".join(f"{n / 100},1.0,0.5\n" for n in range(100))


@pytest.fixture
def scenario(tmp_path):
    """Write a scenario that names files beside it, and return it."""
    folder = tmp_path / "study"
    (folder / "data").mkdir(parents=True)
    (folder / "data" / "own.urdf").write_text(ROBOT)
    (folder / "data" / "push.csv").write_text(ROWS)
    data = read_document(scenario_library()["walk"]).data
    data["plant"]["parameters"]["robot"] = {"urdf": "data/own.urdf"}
    data["human"] = {"name": "recorded", "parameters": {"file": "./data/push.csv"}}
    data["duration"], data["expect"] = 1.0, {}
    file = folder / "study.scenario.yaml"
    file.write_text(yaml.safe_dump(data))
    return file


def named(loaded):
    robot = loaded.plant.parameters["robot"]["urdf"]
    return Path(loaded.human.parameters["file"]), Path(robot)


@pytest.mark.parametrize("where", ["elsewhere", "study", "."])
def test_relative_paths_begin_at_the_scenario_wherever_it_is_run(scenario, monkeypatch, where):
    (scenario.parents[1] / "elsewhere").mkdir()
    monkeypatch.chdir(scenario.parents[1] / where)
    loaded = load(os.path.relpath(scenario))
    assert named(loaded) == (
        scenario.parent / "data" / "push.csv",
        scenario.parent / "data" / "own.urdf",
    )
    assert faults(scenario) == []


def test_paths_from_an_override_begin_in_the_working_folder(scenario, tmp_path, monkeypatch):
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    Path("other.csv").write_text(ROWS)
    loaded = load(scenario, ["human.parameters.file=other.csv"])
    assert loaded.human.parameters["file"] == "other.csv"
    assert named(loaded)[1] == scenario.parent / "data" / "own.urdf"
    with pytest.raises(InputError, match="there is no such file"):
        load(scenario, ["human.parameters.file=data/push.csv"])


def test_absolute_paths_stay_and_missing_files_are_named_in_full(scenario, tmp_path):
    text = scenario.read_text()
    here = tmp_path / "study" / "data" / "push.csv"
    scenario.write_text(text.replace("./data/push.csv", str(here)))
    assert named(load(scenario))[0] == here
    scenario.write_text(text.replace("push.csv", "pull.csv"))
    missing = tmp_path / "study" / "data" / "pull.csv"
    with pytest.raises(InputError, match="there is no such file") as refused:
        load(scenario)
    assert str(missing) in str(refused.value)
    (fault,) = faults(scenario)
    assert fault.key == "human.parameters.file"


def test_a_scenario_written_back_finds_its_files_from_anywhere(scenario, tmp_path):
    copy = tmp_path / "copy.yaml"
    copy.write_text(to_yaml(load(scenario)))
    assert named(load(copy)) == named(load(scenario))


def test_a_run_from_another_folder_reads_the_files(scenario, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    arguments = ["run", str(scenario), "--out", str(tmp_path / "run"), "--no-figure"]
    monkeypatch.setattr(sys, "argv", ["cowalk", *arguments])
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 0, capfd.readouterr().err


def test_a_part_of_ones_own_marks_its_files(scenario, monkeypatch):
    module = scenario.parent / "own_pushes.py"
    module.write_text(
        "from pathlib import Path\n"
        "import numpy as np\n"
        "from cowalk.agents import Truth\n"
        "class Pushes:\n"
        "    def __init__(self, table: Path, note: str = ''):\n"
        "        self.push = np.loadtxt(table, delimiter=',', skiprows=1)[0, 1:]\n"
        "        self.note = note\n"
        "    def reset(self, rng, situation): pass\n"
        "    def act(self, observation): return self.push\n"
        "    def truth(self): return Truth(np.zeros(2), np.zeros(2))\n"
    )
    data = yaml.safe_load(scenario.read_text())
    parameters = {"table": "data/push.csv", "note": "data/push.csv"}
    data["human"] = {"name": "own_pushes:Pushes", "parameters": parameters}
    scenario.write_text(yaml.safe_dump(data))
    loaded = load(scenario, trust=True).human.parameters
    assert loaded["table"] == str(scenario.parent / "data" / "push.csv")
    assert loaded["note"] == "data/push.csv"


@pytest.mark.parametrize(
    ("hint", "expected"),
    [
        *((FileName, True), (FileName | None, True), (Path, True), (str | Path, True)),
        *((str, False), (None, False), (str | None, False), (dict[str, float], False)),
        *((str | os.PathLike, True), (tuple[FileName, ...], True)),
    ],
)
def test_annotations_say_what_names_a_file(hint, expected):
    assert names_file(hint) == expected
