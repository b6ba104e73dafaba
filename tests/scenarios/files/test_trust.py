"""A file from a stranger imports and runs nothing, whatever it names and however it is read."""

import os
import pickle
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
import yaml
from pyarrow import parquet

from cowalk.scenarios import SingleSeatEnv, load, load_population, make_env
from cowalk.scenarios.files.loading import faults
from cowalk.scenarios.files.parts import parts
from cowalk.scenarios.files.trust import VARIABLE
from cowalk.sim.basics.errors import InputError

SAID = "names code, not checked: "

# It would serve as a part of any kind; importing it is already too much.
TRAP = """\
from pathlib import Path
(Path(__file__).parent / "was run").touch()

class Mine:
    def __getattr__(self, name):
        return lambda *args, **more: None
"""


@pytest.fixture(autouse=True)
def nothing_is_run(folder):
    """Every module that a stranger's file could name leaves a mark when it is imported."""
    (folder / "trap.py").write_text(TRAP)
    yield
    sys.modules.pop("trap", None)
    assert not (folder / "was run").exists()


KINDS = [part for part in parts() if not part.preset]


@pytest.fixture(params=KINDS, ids=lambda part: part.kind)
def foreign(scenario_file, request):
    """A scenario that names code for a part, of every kind in turn."""
    file = scenario_file()
    data = yaml.safe_load(file.read_text())
    data["automation"] = {"name": "never-yields"}
    place = data
    for step in request.param.section[:-1]:
        place = place[step]
    place[request.param.key] = ["trap:Mine"] if request.param.many else {"name": "trap:Mine"}
    file.write_text(yaml.safe_dump(data))
    return file


def test_reading_and_checking_import_nothing(foreign, cowalk):
    (fault,) = faults(foreign)
    assert fault.message.startswith(SAID)
    assert "'trap:Mine'" in fault.message
    for read in (load, make_env, SingleSeatEnv):
        with pytest.raises(InputError, match=SAID):
            read(str(foreign))
    code, out, error = cowalk("check", "--strict", foreign)
    assert (code, error) == (2, "")
    assert len(out.splitlines()) == 1
    assert SAID in out
    assert "--trust" in out


@pytest.mark.parametrize(
    "command", [["run"], ["run", "--show"], ["compare", "smoothers"]], ids=" ".join
)
def test_no_command_imports_it(foreign, command, cowalk):
    code, out, error = cowalk(*command, foreign)
    assert (code, out) == (2, "")
    assert len(error.splitlines()) == 1
    assert "--trust" in error


def test_a_population_imports_nothing_either(folder, cowalk):
    file = folder / "mine.population.yaml"
    people = {"human": {"name": "steady", "imperfections": [{"name": "trap:Mine"}]}}
    for human in ({"human": "trap:Mine"}, {"human": {"name": "trap:Mine"}}, people):
        file.write_text(yaml.safe_dump({"name": "mine", "groups": [{"human": "steady"}, human]}))
        with pytest.raises(InputError, match=SAID):
            load_population(file)
        code, _, error = cowalk("humans", "sample", file)
        assert code == 2
        assert "mine.population.yaml:" in error
        with pytest.raises(InputError, match=SAID):
            SingleSeatEnv("walk", population=file)


def test_pytest_collects_and_runs_without_importing_it(pytester):
    (pytester.path / "foreign.scenario.yaml").write_text(
        "name: foreign\nworld: {path: {points: [[0, 0], [9, 0]]}}\n"
        "human: trap:Mine\nautomation: never-yields\n"
    )
    (pytester.path / "trap.py").write_text(TRAP)
    collected = pytester.runpytest_inprocess("--collect-only")
    assert collected.ret == 0
    ran = pytester.runpytest_inprocess()
    ran.assert_outcomes(failed=1)
    ran.stdout.fnmatch_lines([f"*{SAID}*--cowalk-trust*"])
    assert not (pytester.path / "was run").exists()


@pytest.mark.parametrize(
    "text",
    [
        "human: &who {name: 'trap:Mine'}",
        "human: {<<: {name: 'trap:Mine'}}",
        'human: {name: "trap\\x3aMine"}',
        "human: !!str trap:Mine",
        "human: {name: >-\n    trap:Mine\n  }",
        "human: {name: steady, name: 'trap:Mine'}",
        "human: {name: steady, imperfections: [tremor, 'trap:Mine']}",
    ],
)
def test_no_way_of_writing_it_hides_it(scenario_file, text, cowalk):
    file = scenario_file(("human:\n  name: steady", text))
    code, out, _ = cowalk("check", file)
    assert code == 2
    assert "trap" in out or "is not YAML" in out


@pytest.mark.parametrize(
    "text",
    [
        "human: !!python/name:trap.Mine {}",
        "human: !!python/object/apply:os.system [touch 'was run']",
        "human: !!python/object/new:trap.Mine {}",
        "human: !!python/module:trap {}",
        "human: {name: trap.Mine}",
        'human: {name: "trap\uff1aMine"}',
        "human: steady\nextends: trap:Mine",
        "human: steady\nimports: [trap]",
        "human: {name: steady, parameters: {level: !!python/name:trap.Mine ''}}",
        "human: {name: steady, intention: {path: 'trap:Mine'}}",
        "human: steady\nsensor: trap:Mine",
        "human: steady\nsensor: {preset: 'trap:Mine'}",
        "human: steady\nexpect: {bad: from trap import Mine}",
        "human: steady\nexpect: {bad: 'trap:Mine'}",
    ],
)
def test_what_is_no_part_names_no_code(scenario_file, text):
    file = scenario_file(("human:\n  name: steady", text))
    assert faults(file, trust=True)


@pytest.mark.parametrize("distribution", ["trap:Mine", "os.system", "__builtins__", "np", "sys"])
def test_a_distribution_is_one_of_scipys(folder, distribution):
    file = folder / "mine.population.yaml"
    level = {"distribution": distribution}
    human = {"name": "slacking", "parameters": {"share": level}}
    file.write_text(yaml.safe_dump({"name": "mine", "groups": [{"human": human}]}))
    with pytest.raises(InputError, match="is no distribution of scipy"):
        load_population(file, trust=True)


def test_what_the_user_names_instead_is_all_that_is_imported(scenario_file, cowalk):
    file = scenario_file(("name: steady", "name: trap:Mine"))
    assert load(file, ["human=steady"]).human.name == "steady"
    code, _, _ = cowalk("run", file, "--human", "steady", "--show")
    assert code == 0
    code, out, error = cowalk("run", file, "--human", "my_models:Quiet", "--no-figure", "--json")
    assert (code, '"my_models:Quiet"' in out) == (0, True), error


def test_naming_code_does_not_trust_what_lies_beside_a_file(folder, monkeypatch):
    # The same name is said, and is nowhere in the user's own folders.
    there = folder / "downloads"
    there.mkdir()
    text = textwrap.dedent(
        """
        name: walk
        plant: unicycle
        world: {path: {points: [[0.0, 0.0], [30.0, 0.0]]}}
        human: hidden_trap:Mine
        automation: never-yields
        """
    )
    (there / "walk.scenario.yaml").write_text(text)
    (there / "hidden_trap.py").write_text(TRAP)
    (folder / "work").mkdir()
    monkeypatch.chdir(folder / "work")
    with pytest.raises(InputError, match="No module named 'hidden_trap'"):
        load(there / "walk.scenario.yaml", ["human=hidden_trap:Mine"])
    assert not (there / "was run").exists()


def test_a_trusted_file_makes_no_other_one_trusted(scenario_file):
    mine = scenario_file(("name: steady", "name: my_models:Quiet"), name="mine.yaml")
    assert load(mine, trust=True).human.name == "my_models:Quiet"
    with pytest.raises(InputError, match=SAID):
        load(mine)
    with pytest.raises(InputError, match=SAID):
        load(scenario_file(("name: steady", "name: trap:Mine")))


def test_folders_of_the_users_own_are_trusted(scenario_file, folder, monkeypatch):
    mine = scenario_file(("name: steady", "name: my_models:Quiet"))
    monkeypatch.setenv(VARIABLE, os.pathsep.join(["/nowhere", str(folder), ""]))
    assert load(mine).human.name == "my_models:Quiet"
    monkeypatch.setenv(VARIABLE, str(folder)[:-1])  # no folder, but its name begins so
    assert faults(mine)
    monkeypatch.setenv(VARIABLE, "")
    assert faults(mine)
    monkeypatch.setenv(VARIABLE, f"{folder / 'deeper'}/../")
    assert faults(mine) == []


def test_a_link_in_a_trusted_folder_to_a_file_elsewhere_is_not_trusted(folder, monkeypatch):
    (folder / "mine").mkdir()
    (folder / "theirs").mkdir()
    text = "human: trap:Mine\nautomation: never-yields\nname: walk\n"
    (folder / "theirs" / "walk.yaml").write_text(text)
    (folder / "mine" / "walk.yaml").symlink_to(folder / "theirs" / "walk.yaml")
    (folder / "mine" / "deep").symlink_to(folder / "theirs")
    monkeypatch.setenv(VARIABLE, str(folder / "mine"))
    for file in (folder / "mine" / "walk.yaml", folder / "mine" / "deep" / "walk.yaml"):
        (fault,) = faults(file)
        assert fault.message.startswith(SAID)


@pytest.mark.parametrize("entry", [".", "work", "..", "./work"])
def test_a_folder_that_depends_on_where_one_is_is_never_trusted(entry, scenario_file, monkeypatch):
    monkeypatch.setenv(VARIABLE, entry)
    with pytest.raises(InputError, match=f"{VARIABLE}: '.*' is not absolute"):
        load(scenario_file(("name: steady", "name: trap:Mine")))


def test_an_environment_inside_the_working_folder_finds_nothing_there(folder):
    # `pip` puts packages beneath many a project; none of them may import what lies in it.
    inside = folder / ".venv" / "site-packages"
    inside.mkdir(parents=True)
    (inside / "asks_for_more.py").write_text("try:\n    import trap\nexcept ImportError: pass\n")
    code = (
        "import sys\n"
        "from cowalk.sim.basics.registry import import_address\n"
        f"sys.path.append({str(inside)!r})\n"
        "import_address('my_models:Quiet')\n"
        "import asks_for_more\n"
    )
    subprocess.run([sys.executable, "-P", "-c", code], cwd=folder, check=True)


class Bomb:
    """Touches a file when it is unpickled."""

    def __init__(self, mark):
        self.mark = str(mark)

    def __reduce__(self):
        return Path.touch, (Path(self.mark),)


def bombs(folder):
    bomb = Bomb(folder / "was run")
    rows = np.array([[bomb, bomb, bomb]] * 3, dtype=object)
    np.save(folder / "array.npy", rows, allow_pickle=True)
    np.savez(folder / "arrays.npz", t_s=rows[:, 0], fx_n=rows[:, 1], fy_n=rows[:, 2])
    (folder / "pickle.npy").write_bytes(pickle.dumps(bomb))
    (folder / "pickle.csv").write_bytes(pickle.dumps(bomb))
    cereal = {b"ARROW:extension:name": b"arrow.py_extension_type"}
    cereal[b"ARROW:extension:metadata"] = pickle.dumps(bomb)
    names = ("t_s", "fx_n", "fy_n")
    schema = pa.schema([pa.field(name, pa.float64(), metadata=cereal) for name in names])
    columns = [pa.array([0.0, 0.1, 0.2]), pa.array([0.0] * 3), pa.array([0.0] * 3)]
    parquet.write_table(pa.table(columns, schema=schema), folder / "extension.parquet")
    return ["array.npy", "arrays.npz", "pickle.npy", "pickle.csv", "extension.parquet"]


def test_no_recording_is_unpickled(folder, scenario_file):
    for name in bombs(folder):
        (folder / "was run").unlink(missing_ok=True)  # pyarrow's writer reads what it wrote
        what = f"name: recorded\n  parameters: {{file: {name}}}"
        found = faults(scenario_file(("name: steady", what)))
        if not name.endswith(".parquet"):
            assert "human.parameters.file" in str(found[0])
        assert not (folder / "was run").exists()
