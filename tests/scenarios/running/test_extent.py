"""Who walks where, and how wide they are: the human's way around things follows the bodies."""

import numpy as np
import pytest

from cowalk.scenarios.files.loading import load
from cowalk.scenarios.running.build import make_env
from cowalk.scenarios.running.outlines import extent
from cowalk.scenarios.running.runner import run
from cowalk.sim.basics.situation import SIDE_BY_SIDE

WIDE = """\
<robot name="wide"><link name="base">
<inertial><mass value="40"/><inertia ixx="2" iyy="2" izz="3" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 0.3"/><geometry><box size="0.6 1.4 0.6"/></geometry></collision>
</link><link name="grip"/>
<joint name="bar" type="fixed"><parent link="base"/><child link="grip"/>
<origin xyz="-0.2 -0.55 0.9"/>
</joint></robot>
"""

GLIDING = "plant.parameters.gait.enabled=false"
"""A gait's sway has a phase of its own, which no mirror turns."""


def extent_of(*overrides):
    env = make_env(load("puddle", [GLIDING, *overrides]))
    env.reset(seed=0)
    found = extent(env)
    env.close()
    return found


def test_the_extent_is_that_of_the_bodies_as_they_set_out():
    assert extent_of("plant=unicycle") == pytest.approx(SIDE_BY_SIDE)
    usual = extent_of()
    assert usual == pytest.approx(SIDE_BY_SIDE, abs=0.05)
    left, right, behind = extent_of("plant.parameters.body.hand=right")
    assert (right, left, behind) == pytest.approx(usual)
    left, right, behind = extent_of("plant.parameters.coupling={kind: stretcher}")
    assert max(left, right) < 0.6
    assert behind > 1.2


def test_the_extent_turns_with_the_base():
    sideways = "world.path={points: [[0, 0], [0, 20]]}"
    assert extent_of(sideways, "world.obstacles=[]") == pytest.approx(extent_of())


def test_a_world_in_the_mirror_is_walked_in_the_mirror():
    # Held by the other hand, past a puddle on the other side: nothing may know left from right.
    still = "sensor=none", GLIDING
    walk = run(load("puddle", still)).trace
    other = run(
        load(
            "puddle",
            [*still, "plant.parameters.body.hand=right", "world.obstacles.0.y=1.05"],
        )
    ).trace
    assert len(walk) == len(other)
    for name in ("y", "theta", "omega", "fy", "human_y", "fy_intent", "est_omega", "wish_omega"):
        np.testing.assert_allclose(other[name], -walk[name], atol=1e-8, err_msg=name)
    for name in ("x", "v", "fx", "human_x", "clearance", "utility_loss"):
        np.testing.assert_allclose(other[name], walk[name], atol=1e-8, err_msg=name)


def test_beside_a_wide_robot_a_human_keeps_as_far_from_what_they_see(folder):
    (folder / "wide.urdf").write_text(WIDE)
    wide = "plant.parameters.robot={urdf: wide.urdf, handle: grip}"
    left, right, _ = extent_of(wide)
    assert left == pytest.approx(0.7, abs=1e-3)
    assert right > SIDE_BY_SIDE[1] + 0.2
    on_the_left = ("world.corridor.width=8.0", "world.obstacles.0.y=0.5")
    for robot in ((), (wide,)):
        trace = run(load("puddle", [*on_the_left, *robot])).trace
        assert trace["clearance"].min() > 0.05
