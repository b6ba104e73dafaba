"""Robots as their makers publish them: excerpts made up for the purpose, one fault each."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.frames import about, roll_pitch_yaw, rotation
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.robot.robot import RobotParameters, robot_of
from cowalk.sim.urdf.read import link_frames
from cowalk.sim.urdf.rigid import SPECK
from cowalk.sim.world.world import World

BASE = """<link name="base"><inertial><origin xyz="0 0 0.3"/><mass value="40"/>
  <inertia ixx="2" iyy="2" izz="3" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><origin xyz="0 0 0.4"/><geometry><cylinder radius="0.25" length="0.8"/></geometry>
  </collision></link>"""
ARM = """<link name="upper"><inertial><mass value="4"/>
  <inertia ixx="0.01" iyy="0.02" izz="0.02"/></inertial></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
  <origin xyz="0.2 0 0.9" rpy="0 0 0.5"/><axis xyz="0 0 2"/>
  <limit lower="-1.5" upper="1.5"/></joint>
<link name="fore"><inertial><origin xyz="0.3 0 0"/><mass value="2"/></inertial></link>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/>
  <origin xyz="0.4 0 0" rpy="0.3 0.2 0.1"/><axis xyz="0 1 0"/></joint>
<link name="lift"/>
<joint name="spindle" type="prismatic"><parent link="fore"/><child link="lift"/>
  <axis xyz="0 0 1"/><limit lower="0" upper="0.5"/></joint>
<link name="finger"/>
<joint name="knuckle" type="revolute"><parent link="lift"/><child link="finger"/>
  <origin xyz="0.1 0 0"/><axis xyz="0 0 1"/><limit lower="-3" upper="3"/>
  <mimic joint="elbow" multiplier="-0.5" offset="0.1"/></joint>"""
HANDLE = """<link name="handle"/><joint name="bar" type="fixed"><parent link="base"/>
  <child link="handle"/><origin xyz="-0.4 0 0.9" rpy="0 0 1.5707963267948966"/></joint>"""


def urdf(*parts):
    return f'<robot name="excerpt">{"".join((BASE, HANDLE, *parts))}</robot>'


def part(inner, kind="fixed"):
    return (
        f'<link name="part">{inner}</link><joint name="mount" type="{kind}">'
        '<parent link="base"/><child link="part"/><origin xyz="0.1 0 0.7"/></joint>'
    )


@pytest.fixture
def robot(tmp_path):
    """Read a robot from its text."""

    def read(text, **parameters):
        file = tmp_path / "robot.urdf"
        file.write_text(text)
        return robot_of(RobotParameters(str(file), **parameters), "left", "handle")

    return read


def inertial(mass, **moments):
    numbers = {"ixx": 0.0, "iyy": 0.0, "izz": 0.0, "ixy": 0.0, "ixz": 0.0, "iyz": 0.0} | moments
    inertia = " ".join(f'{key}="{value!r}"' for key, value in numbers.items())
    return f'<inertial><mass value="{mass}"/><inertia {inertia}/></inertial>'


IMPOSSIBLE = [
    {"ixx": 1e-5, "iyy": 1e-5, "izz": 1e-5, "ixy": 3e-5},
    {"ixx": 0.001, "iyy": 0.001, "izz": 0.01},
    {"izz": 1e-6},
    {"ixx": -1e-7, "iyy": 1e-7, "izz": 1e-7},
]


@pytest.mark.parametrize("moments", IMPOSSIBLE)
@pytest.mark.parametrize("mass", [1e-6, 0.05])
def test_a_speck_may_have_an_inertia_that_no_body_has(robot, moments, mass):
    rigid = robot(urdf(part(inertial(mass, **moments)))).rigid
    point = robot(urdf(part(inertial(mass)))).rigid
    assert rigid == point


@pytest.mark.parametrize("moments", IMPOSSIBLE)
def test_a_part_that_matters_may_not(robot, moments):
    with pytest.raises(InputError, match="link 'part' has "):
        robot(urdf(part(inertial(2 * SPECK * 40.0, **moments))))
    with pytest.raises(InputError, match="link 'base' has "):
        robot(urdf().replace('izz="3"', 'izz="-3e-8"'))


def test_nor_a_speck_whose_inertia_would_matter(robot):
    with pytest.raises(InputError, match=r"link 'part' has principal moments 0.01, 0.01, 1 kg"):
        robot(urdf(part(inertial(0.01, ixx=0.01, iyy=0.01, izz=1.0))))


@pytest.mark.parametrize("kind", ["fixed", "revolute"])
def test_a_solid_part_without_mass_adds_its_shape_alone(robot, kind):
    shape = '<collision><geometry><box size="0.1 1.2 0.1"/></geometry></collision>'
    bare, more = robot(urdf()), robot(urdf(part(shape, kind)))
    assert more.rigid.mass == bare.rigid.mass
    assert more.rigid.yaw_inertia == bare.rigid.yaw_inertia
    assert more.outline.box[3] == pytest.approx(0.6)


def test_a_base_whose_mass_hangs_below_a_root_without_any_is_taken(robot):
    root = '<link name="root"><collision><geometry><sphere radius="0.2"/></geometry></collision>'
    joint = '</link><joint name="j" type="{}"><parent link="root"/><child link="base"/></joint>'
    assert robot(urdf(root, joint.format("fixed"))).rigid.mass == 40.0
    with pytest.raises(InputError, match="'root' has collision shapes but no mass, like all that"):
        robot(urdf(root, joint.format("continuous")))


DAE = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
 version="1.4.1"><asset>{unit}<up_axis>{up}</up_axis></asset><library_geometries>
<geometry id="g"><mesh><source id="s"><float_array id="f" count="12">0 0 0 {x} 0 0 0 {y} 0 0 0 {z}
</float_array><technique_common><accessor source="#f" count="4" stride="3"><param name="X"
 type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w"><node><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>"""


@pytest.mark.parametrize("name", ["part.dae", "PART.DAE"])
@pytest.mark.parametrize("up", ["Z_UP", "Y_UP"])
@pytest.mark.parametrize(
    ("unit", "metre"),
    [
        ("", 1.0),
        ('<unit name="meter" meter="1"/>', 1.0),
        ('<unit name="centimeter" meter="0.01"/>', 100.0),
        ('<unit name="inch" meter="0.0254"/>', 1.0 / 0.0254),
    ],
)
def test_collada_is_solid_in_its_own_unit_and_as_it_lies(robot, tmp_path, name, up, unit, metre):
    x, y, z = 0.7 * metre, 0.5 * metre, 0.9 * metre
    (tmp_path / name).write_text(DAE.format(unit=unit, up=up, x=x, y=y, z=z))
    mesh = f'<mesh filename="{name}" scale="1 2 1"/>'
    found = robot(urdf(part(f"<collision><geometry>{mesh}</geometry></collision>")))
    assert found.outline.box[1] == pytest.approx(0.1 + 0.7)
    assert found.outline.box[3] == pytest.approx(2.0 * 0.5)
    assert max(solid.top for solid in found.solids) == pytest.approx(0.7 + 0.9)


XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('xyz="-0.4 0 0.9"', 'xyz="$(optenv BAR -0.4 0 0.9)"'),
        ('xyz="-0.4 0 0.9"', 'xyz="${-length / 2} 0 0.9"'),
        ('<mass value="40"/>', '<mass value="$(arg mass)"/>'),
        ('radius="0.25"', 'radius="${radius}"'),
        ('<cylinder radius="0.25" length="0.8"/>', '<mesh filename="$(find it)/a.stl"/>'),
        ('link name="handle"', 'link name="${prefix}handle"'),
        ('child link="handle"', 'child link="$(arg prefix)handle"'),
        ('joint name="bar"', 'joint name="${prefix}bar"'),
        ('<link name="handle"/>', '<link name="handle"/><xacro:wheel prefix="left"/>'),
        ('<link name="handle"/>', '<link name="handle"/><macro name="wheel"/>'),
        ('<link name="handle"/>', '<link name="handle"/><include filename="wheel.xacro"/>'),
    ],
)
def test_what_xacro_should_have_expanded_is_named_as_such(robot, old, new):
    text = urdf().replace('<robot name="excerpt">', f'<robot name="excerpt" {XACRO}>')
    robot(text)  # the name of the namespace alone is left by xacro itself
    assert text.count(old) == 1
    with pytest.raises(InputError, match="xacro") as refused:
        robot(text.replace(old, new))
    assert "expand the file first: xacro in.xacro > out.urdf" in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "text",
    [
        f'<robot name="own" {XACRO}><xacro:include filename="base.xacro"/></robot>',
        f'<robot name="own" {XACRO}><xacro:macro name="a"><link name="b"/></xacro:macro></robot>',
        '<robot name="own"><xacro:include filename="base.xacro"/></robot>',
        '<robot name="own"><property name="width" value="1"/></robot>',
    ],
)
def test_a_file_of_macros_is_named_as_such(robot, text):
    with pytest.raises(
        InputError, match=r"^robot\.urdf = .*xacro.*expand the file first"
    ) as refused:
        robot(text)
    assert refused.value.at == ("robot", "urdf")


def test_substitutions_in_what_nobody_reads_are_left_alone(robot):
    other = '<gazebo><plugin name="$(arg ns)"><rate>${50}</rate></plugin></gazebo>'
    robot(urdf(other, '<transmission name="${a}"/>'))


def frames(robot, text, **joints):
    root = ElementTree.fromstring(robot(text, joints=joints).urdf)
    return link_frames(root)


def test_joints_stand_where_they_are_put(robot):
    turned = frames(robot, urdf(ARM), shoulder=0.7, elbow=-1.1, spindle=0.25)
    upper = rotation(0, 0, 1.2)
    fore = upper @ rotation(0.3, 0.2, 0.1) @ rotation(0, -1.1, 0)
    elbow = np.array([0.2, 0, 0.9]) + upper @ (0.4, 0, 0)
    lift = elbow + fore @ (0, 0, 0.25)
    knuckle = fore @ rotation(0, 0, 0.55 + 0.1)  # it mimics the elbow
    for link, turn, place in (
        ("upper", upper, (0.2, 0, 0.9)),
        ("fore", fore, elbow),
        ("lift", fore, lift),
        ("finger", knuckle, lift + fore @ (0.1, 0, 0)),
    ):
        np.testing.assert_allclose(turned[link][0], turn, atol=1e-12)
        np.testing.assert_allclose(turned[link][1], place, atol=1e-12)


def test_masses_follow_the_joints_and_none_given_changes_nothing(robot):
    rest, folded = robot(urdf(ARM)), robot(urdf(ARM), joints={"shoulder": 1.0})
    assert robot(urdf(ARM), joints={}).rigid == rest.rigid
    assert folded.rigid.centre[1] > rest.rigid.centre[1] + 0.01


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        ({"sholder": 0.1}, "joints.sholder: no such joint; did you mean 'shoulder'"),
        ({"bar": 0.1}, "joints.bar: this joint is 'fixed': it must be one of revolute, continu"),
        ({"knuckle": 0.1}, "joints.knuckle: it follows joint 'elbow'; set that one"),
        ({"shoulder": 1.6}, "joints.shoulder: 1.6 rad is beyond its limits, -1.5 to 1.5 rad"),
        ({"spindle": -0.1}, "joints.spindle: -0.1 m is beyond its limits, 0 to 0.5 m"),
    ],
)
def test_joints_that_cannot_be_so_are_named(robot, joints, message):
    with pytest.raises(InputError, match=f"^robot.{re.escape(message)}") as refused:
        robot(urdf(ARM), joints=joints)
    assert refused.value.at == ("robot", "joints", *joints)


@pytest.mark.parametrize("angle", [-3.0, 0.4, np.pi / 2, 2.0])
@pytest.mark.parametrize("pitch", [-np.pi / 2, 0.3, np.pi / 2])
def test_angles_of_a_rotation_give_that_rotation(pitch, angle):
    turn = rotation(angle, pitch, -0.7)
    np.testing.assert_allclose(rotation(*roll_pitch_yaw(turn)), turn, atol=1e-9)
    np.testing.assert_allclose(about((0, 1, 0), angle), rotation(0, angle, 0), atol=1e-12)


def test_a_handle_may_be_a_place_off_a_link_and_goes_with_its_joints(robot):
    held = robot(urdf(), handle_offset=(0.05, 0.1, -0.2)).handle
    assert held == pytest.approx((-0.4 - 0.1, 0.05, 0.7))  # the link is turned by a quarter
    away = {"handle": "fore", "handle_offset": (0.1, 0.0, 0.0)}
    turn, place = frames(robot, urdf(ARM), shoulder=0.7)["fore"]
    held = robot(urdf(ARM), joints={"shoulder": 0.7}, **away).handle
    assert held == pytest.approx(tuple(place + turn @ (0.1, 0.0, 0.0)))


def test_a_robot_held_off_a_link_with_its_arm_folded_walks(tmp_path):
    file = tmp_path / "robot.urdf"
    file.write_text(urdf(ARM))
    held = {"handle": "base", "handle_offset": (-0.4, 0.0, 0.9), "joints": {"shoulder": -1.0}}
    plant = BulletPlant(Rates(), robot=RobotParameters(str(file), **held))
    plant.reset(World(Path(((0, 0), (20, 0)))), np.random.default_rng(0))
    states = [plant.step((0.8, 0.0), (2.0, 0.0)) for _ in range(100)]
    plant.close()
    assert states[-1].grip_held
    assert states[-1].twist[0] == pytest.approx(0.8, abs=0.05)
