"""The house is in order: small rooms, each on the map, none of them behind another's back.

What may import what is held by the contracts in pyproject.toml (`make lint`); here is the rest.
"""

import ast
import re
import tomllib
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PARTS = ("sim", "estimation", "agents", "scenarios")
MODULES = sorted(file.relative_to(ROOT) for part in PARTS for file in (ROOT / part).rglob("*.py"))
ROOMS = sorted({file.parent for file in MODULES})
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]
ONE_FILE_A_PART = {
    Path("agents/humans"),
    Path("agents/imperfections"),
    Path("agents/automations/strategies"),
    Path("estimation/front_ends"),
    Path("estimation/observers"),
    Path("estimation/smoothers"),
}
"""Rooms that grow by a file with every registered part."""
FLAT = {
    "sim": "arguments actions anthropometry arm bodies bullet_bodies bullet_coupling bullet_engine "
    "bullet_floor bullet_grip bullet_pair bullet_scene bullet_scenery bullet_shared bullet_view "
    "bullet_wheels bullet_world camera clearance contact corridor drive errors eyes footprint "
    "frames gains gait grip heights human_body human_figure motion observation outline overlap "
    "parameters path pedestrians perception plants registry reward saved seats sensor_channels "
    "sensor_filter sensor_parameters sensor_transmission shapes sight stability topview "
    "urdf_chain urdf_check urdf_colours urdf_outline walker wheels window wrench",
    "estimation": "intent scoring smoothing stubbornness",
    "agents": "check_rules check_walk interfaces steering "
    "automations.constant automations.settings automations.stubbornness automations.utility "
    "humans.demand humans.detour humans.elementwise humans.linear humans.lq_game "
    "humans.minimum_jerk humans.recording humans.recording_files humans.recording_units "
    "humans.route",
    "scenarios": "answers bodies building calibration checking cli_humans cli_list cli_output "
    "cli_studies compare distribution documents expectations figures_humans figures_panels "
    "figures_paper figures_style figures_top_view formulas human_answers human_pictures "
    "human_table humans loading margins metrics overrides paper population recording "
    "recording_shapes results runner schema sensing stl video video_frame watching wording",
}
"""Where things stood when a part was one flat folder."""


def test_no_room_is_crowded():
    crowded = {
        str(room): count
        for room in ROOMS
        if room not in ONE_FILE_A_PART and (count := len([*(ROOT / room).glob("*.py")]) - 1) > 14
    }
    assert not crowded


@pytest.mark.parametrize("room", sorted(ONE_FILE_A_PART), ids=str)
def test_rooms_that_may_grow_are_there(room):
    assert room in ROOMS


def test_no_module_is_long():
    lengths = {str(file): len((ROOT / file).read_text().splitlines()) for file in MODULES}
    assert not {file: length for file, length in lengths.items() if length > 300}


def test_every_room_says_in_a_sentence_what_it_is():
    said = {room: ast.parse((ROOT / room / "__init__.py").read_text()) for room in ROOMS}
    first = {
        str(room): (ast.get_docstring(tree) or "").partition("\n")[0] for room, tree in said.items()
    }
    assert not [room for room, line in first.items() if not line.endswith(".")]


def test_every_room_is_on_the_map():
    text = (ROOT / "ARCHITECTURE.md").read_text()
    assert not [str(room) for room in ROOMS if f"`{room}/`" not in text]


def test_the_map_names_no_room_that_is_gone():
    named = re.findall(
        rf"`((?:{'|'.join(PARTS)})/[a-z_/]*)/`", (ROOT / "ARCHITECTURE.md").read_text()
    )
    assert {Path(name) for name in named} <= set(ROOMS)


@pytest.mark.parametrize(
    "name", [f"cowalk.{part}.{old}" for part, names in FLAT.items() for old in names.split()]
)
def test_no_old_name_leads_anywhere(name):
    assert find_spec(name) is None


def test_tests_mirror_the_rooms():
    folders = {
        file.parent.relative_to(ROOT / "tests") for file in (ROOT / "tests").rglob("test_*.py")
    }
    assert folders - {Path(), Path("fuzz")} <= set(ROOMS)


def test_the_wheel_holds_every_room():
    names = ["cowalk." + ".".join(room.parts) for room in ROOMS]
    assert PROJECT["setuptools"]["packages"] == names


def test_no_contract_on_imports_is_softened():
    contracts = PROJECT["importlinter"]["contracts"]
    assert not [contract for contract in contracts if "ignore_imports" in contract]
    (basics,) = [
        item for item in contracts if "cowalk.sim.world" in item.get("forbidden_modules", ())
    ]
    rooms = {room.parts[1] for room in ROOMS if room.parts[0] == "sim" and len(room.parts) > 1}
    assert set(basics["forbidden_modules"]) == {f"cowalk.sim.{name}" for name in rooms - {"basics"}}


def test_only_the_engine_names_pybullet():
    """Neither in an import nor in a string, by which `importlib` would take it."""
    naming = {file for file in MODULES if _names(file, "pybullet")}
    assert naming == {Path("sim/engine/engine.py")}


def _names(file, library):
    for node in ast.walk(ast.parse((ROOT / file).read_text())):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [node.module or ""]
        elif isinstance(node, ast.Call):
            names = [a.value for a in node.args if isinstance(a, ast.Constant)]
        else:
            continue
        if any(str(name).partition(".")[0] == library for name in names):
            return True
    return False
