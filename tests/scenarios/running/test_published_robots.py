"""Robots as published in Python packages walk `walk` to its end: ``make robots`` runs this."""

import shutil
from importlib import import_module
from importlib.metadata import distribution
from pathlib import Path

import pytest

from cowalk.scenarios import load, make_env, run
from cowalk.sim.basics.errors import InputError

pytestmark = pytest.mark.robots

MODELS = "cmeel.prefix/share/example-robot-data/robots"
TIAGO = {"handle": "base_link", "handle_offset": [-0.35, 0.0, 0.9]}
PR2 = {"handle": "base_link", "handle_offset": [-0.45, 0.0, 0.9]}
STRETCH = {"handle": "base_link", "handle_offset": [-0.35, 0.1, 0.9]}
HUSKY = {"handle": "base_link", "handle_offset": [-0.6, 0.0, 0.8]}
FOLDED = {"arm_1_joint": 0.2, "arm_2_joint": -1.34, "arm_4_joint": 1.9, "torso_lift_joint": 0.1}


def robot(package, file, **parameters):
    """Return the parameters of a robot, `urdf` being a file of a package."""
    return pytest.param(
        package, file, parameters, id=f"{Path(file).stem}{'-posed' * ('joints' in parameters)}"
    )


ROBOTS = [
    robot("example-robot-data", f"{MODELS}/tiago_description/robots/tiago.urdf", **TIAGO),
    robot(
        "example-robot-data",
        f"{MODELS}/tiago_description/robots/tiago.urdf",
        **TIAGO,
        joints=FOLDED,
    ),
    robot("example-robot-data", f"{MODELS}/tiago_description/robots/tiago_dual.urdf", **TIAGO),
    robot("example-robot-data", f"{MODELS}/tiago_description/robots/tiago_no_hand.urdf", **TIAGO),
    robot("example-robot-data", f"{MODELS}/pr2_description/urdf/pr2.urdf", **PR2),
    robot(
        "example-robot-data",
        f"{MODELS}/pr2_description/urdf/pr2.urdf",
        **PR2,
        joints={"l_shoulder_lift_joint": 1.0, "r_shoulder_lift_joint": 1.0},
    ),
    robot(
        "hello-robot-stretch-urdf",
        "stretch_urdf/SE3/stretch_description_SE3_eoa_wrist_dw3_tool_sg3.urdf",
        **STRETCH,
        joints={"joint_lift": 0.5},
    ),
    robot(
        "hello-robot-stretch-urdf",
        "stretch_urdf/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf",
        **STRETCH,
    ),
    robot("pybullet", "pybullet_data/husky/husky.urdf", **HUSKY),
]


def expanded(file, folder):
    """Return a file as xacro expands it, beside its meshes, where that was left undone."""
    if "$(" not in file.read_text():
        return file
    shutil.copytree(file.parent, folder, dirs_exist_ok=True)
    text = import_module("xacro").process_file(str(file)).toprettyxml()
    (folder / file.name).write_text(text)
    return folder / file.name


@pytest.mark.parametrize(("package", "file", "parameters"), ROBOTS)
def test_a_published_robot_is_held_and_walks_to_the_end(package, file, parameters, tmp_path):
    urdf = expanded(Path(distribution(package).locate_file(file)), tmp_path)
    scenario = load("walk")
    own = {**scenario.plant.parameters, "robot": {"urdf": str(urdf), **parameters}}
    plant = scenario.plant.model_copy(update={"parameters": own})
    scenario = scenario.model_copy(update={"plant": plant})
    result = run(scenario)
    assert result.error is None
    assert result.summary["end"] == "goal"
    assert [verdict.name for verdict in result.verdicts if not verdict.passed] == []
    env = make_env(scenario, render_mode="rgb_array")
    env.reset(seed=0)
    assert env.render().std() > 5.0  # its meshes are drawn too
    env.close()


def test_the_husky_as_it_lies_there_is_told_to_be_expanded():
    file = distribution("pybullet").locate_file("pybullet_data/husky/husky.urdf")
    with pytest.raises(InputError, match=r"\$\(optenv .*xacro in\.xacro > out\.urdf"):
        load("walk", [f"plant.parameters.robot.urdf={file}"])
