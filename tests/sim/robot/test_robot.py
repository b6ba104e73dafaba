"""Robots as one rigid body, left and right swapped, and from a user's own file."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.figure import BodyParameters, figure_urdf
from cowalk.sim.body.human_body import human_body
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import connect, disconnect, engine, load
from cowalk.sim.robot.robot import RobotParameters, robot_of
from cowalk.sim.urdf.read import left_right_swapped, link_frames
from cowalk.sim.urdf.rigid import lump
from cowalk.sim.world.world import World

OWN = """<robot name="own">
  <link name="chassis"><inertial><origin xyz="0 0 0.2"/><mass value="20"/>
    <inertia ixx="1" iyy="1" izz="2" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><box size="0.5 0.4 0.3"/></geometry></visual></link>
  <link name="mast"><inertial><origin xyz="0 0 0.5" rpy="1.5707963267948966 0 0"/>
    <mass value="5"/><inertia ixx="0.1" iyy="0.3" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="grip"/>
  <joint name="mast" type="revolute"><parent link="chassis"/><child link="mast"/>
    <origin xyz="0.2 -0.1 0.3"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="grip" type="fixed"><parent link="mast"/><child link="grip"/>
    <origin xyz="0 -0.2 0.7"/></joint>
</robot>"""


@pytest.fixture
def own(tmp_path):
    path = tmp_path / "own.urdf"
    path.write_text(OWN)
    return path


def test_a_tree_as_one_rigid_body():
    rigid = lump(ElementTree.fromstring(OWN))
    assert rigid.mass == 25.0
    assert rigid.centre == pytest.approx((0.04, -0.02, (20 * 0.2 + 5 * 0.8) / 25))
    # The mast's inertial frame lies on its side: its y axis is vertical. Steiner for the rest.
    steiner = 20 * (0.04**2 + 0.02**2) + 5 * (0.16**2 + 0.08**2)
    assert rigid.yaw_inertia == pytest.approx(2.0 + 0.3 + steiner)
    assert rigid.places["grip"] == pytest.approx((0.2, -0.3, 1.0))


def test_mirroring_twice_changes_nothing():
    root = ElementTree.fromstring(OWN)
    once, twice = lump(left_right_swapped(root)), lump(left_right_swapped(left_right_swapped(root)))
    assert once.places["grip"] == pytest.approx((0.2, 0.3, 1.0))
    assert twice.places["grip"] == pytest.approx(lump(root).places["grip"])
    assert once.yaw_inertia == pytest.approx(twice.yaw_inertia)


def test_a_users_robot_walks_with_its_own_mass(own):
    plant = BulletPlant(
        Rates(), robot=RobotParameters(str(own), "grip"), drive={"gain_forward": 500.0}
    )
    plant.reset(World(Path(((0, 0), (20, 0)))), np.random.default_rng(0))
    states = [plant.step((0.8, 0.0), (4.0, 0.0)) for _ in range(120)]
    assert plant.render(64, 48).std() > 5.0
    plant.close()
    assert states[-1].force_on_base.mean(axis=0) == pytest.approx((4.0, 0.0), abs=0.1)
    assert states[-1].twist[0] == pytest.approx(0.8 + 4.0 / 500.0, abs=1e-3)
    assert states[-1].human_pose[1] == pytest.approx(-0.30 - 0.35 + states[-1].pose[1], abs=0.05)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        (None, "cannot be read"),
        ("<robot>", "no XML"),
        ("<sdf/>", "no <robot> with a <link>"),
        ("<robot><link name='a'/></robot>", "its links have no mass"),
    ],
)
def test_a_file_that_is_no_robot(tmp_path, text, named):
    path = tmp_path / "robot.urdf"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InputError, match=named):
        robot_of(RobotParameters(str(path)), "left", "handle")


CHASSIS = 'ixx="1" iyy="1" izz="2" ixy="0" ixz="0" iyz="0"'
HEAVY = '<mass value="20"/>'


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        (CHASSIS, CHASSIS.replace('izz="2"', 'izz="-2"'), "izz = -2 kg m.2: must be above 0"),
        (CHASSIS, CHASSIS.replace('ixy="0"', 'ixy="1.5"'), "moments -0.5, 2, 2.5 .* above 0"),
        (CHASSIS, CHASSIS.replace('izz="2"', 'izz="4"'), "moments 1, 1, 4 kg m.2: no body can"),
        (HEAVY, '<mass value="-20"/>', "mass = -20 kg"),
    ],
)
def test_masses_and_inertias_that_no_body_has(old, new, named):
    assert old in OWN
    with pytest.raises(InputError, match=f"link 'chassis' has .*{named}"):
        lump(ElementTree.fromstring(OWN.replace(old, new)))


def test_moments_of_inertia_may_be_off_as_those_of_published_robots_are(own):
    own.write_text(OWN.replace('izz="2"', 'izz="2.32"'))
    robot = robot_of(RobotParameters(str(own), "grip"), "left", "handle")
    assert robot.rigid.yaw_inertia == pytest.approx(
        lump(ElementTree.fromstring(OWN)).yaw_inertia + 0.32
    )


def test_a_chain_of_thousands_of_links_is_read_whatever_their_order():
    count = 3000
    joints = "".join(
        f'<joint name="j{n}" type="fixed"><parent link="l{n}"/><child link="l{n + 1}"/>'
        '<origin xyz="0.001 0 0"/></joint>'
        for n in range(count)
    )
    links = "".join(f'<link name="l{n}"/>' for n in reversed(range(count + 1)))
    frames = link_frames(ElementTree.fromstring(f'<robot name="long">{links}{joints}</robot>'))
    assert frames[f"l{count}"][1] == pytest.approx((3.0, 0.0, 0.0))


def test_an_unknown_encoding_is_no_xml(own):
    own.write_text('<?xml version="1.0" encoding="foo"?>' + OWN)
    with pytest.raises(InputError, match=r"own\.urdf'?: no XML: unknown encoding: foo"):
        robot_of(RobotParameters(str(own), "grip"), "left", "handle")


def test_a_robot_in_millimetres_is_refused_at_once(own, tmp_path):
    trimesh.creation.box((600.0, 500.0, 900.0)).export(tmp_path / "mm.stl")
    own.write_text(
        OWN.replace(
            "<visual>",
            '<collision><geometry><mesh filename="mm.stl"/></geometry></collision><visual>',
        )
    )
    words = "of link 'chassis' reaches 450 m from the root: must be 5 m or less; a mesh drawn in mm"
    with pytest.raises(InputError, match=words):
        robot_of(RobotParameters(str(own), "grip"), "left", "handle")


BOX = '<box size="0.5 0.4 0.3"/>'
PLACE = 'xyz="0 -0.2 0.7"'
INERTIAL, VISUAL = "link 'chassis', <inertial>", "link 'chassis', <visual>"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (PLACE, 'xyz="1 2"', """joint 'grip': <origin xyz="1 2">: must be 3 finite numbers, x y"""),
        (PLACE, 'xyz="nan 0 1"', """joint 'grip': <origin xyz="nan 0 1">: must be 3 finite"""),
        (
            PLACE,
            'xyz=""',
            """joint 'grip': <origin xyz="">: must be 3 finite numbers, x y z in m""",
        ),
        (PLACE, 'xyz="0 0 1_0"', """joint 'grip': <origin xyz="0 0 1_0">: must be 3 finite"""),
        (PLACE, 'rpy="0 0"', """<origin rpy="0 0">: must be 3 finite numbers, roll pitch yaw in"""),
        ('xyz="0 0 0.2"', 'xyz="x 0 0"', f'{INERTIAL}: <origin xyz="x 0 0">: must be 3 finite'),
        (HEAVY, '<mass value="inf"/>', f'{INERTIAL}: <mass value="inf">: must be a finite number'),
        (HEAVY, '<mass value="20 kg"/>', f'{INERTIAL}: <mass value="20 kg">: must be a finite'),
        (HEAVY, "<mass/>", f'{INERTIAL}: <mass> without "value": must be a finite number, kg'),
        ('izz="2"', 'izz="two"', f'{INERTIAL}: <inertia izz="two">: must be a finite number, kg'),
        (BOX, '<box size="1 1"/>', f'{VISUAL}: <box size="1 1">: must be 3 finite numbers of at'),
        (BOX, '<sphere radius="-1"/>', f'{VISUAL}: <sphere radius="-1">: must be a finite number'),
        (BOX, '<sphere r="1"/>', f'{VISUAL}: <sphere> without "radius": must be a finite number'),
        (BOX, '<mesh filename="a.stl" scale="a"/>', f'{VISUAL}: <mesh scale="a">: must be 3'),
        (BOX, '<mesh filename="a.stl"/>', f'{VISUAL}: <mesh filename="a.stl">: there is no mesh'),
        (BOX, '<mesh filename="own.urdf"/>', "must be one of .obj, .stl, .dae to be drawn"),
        (BOX, "<mesh/>", f'{VISUAL}: <mesh> without "filename"'),
        (BOX, "<cone/>", f"{VISUAL}: unknown shape <cone>: must have a <geometry> with one of box"),
        (BOX, "", f"{VISUAL}: no shape: must have a <geometry> with one of box, sphere"),
        ("</visual>", '<material><color rgba="1 0"/></material></visual>', '<color rgba="1 0">'),
        ('<child link="grip"/>', "<child/>", """joint 'grip': no <child link="...">"""),
        ('<parent link="mast"/>', '<parent link="mats"/>', "joint 'grip': no parent link 'mats'; "),
        ('<parent link="mast"/>', '<parent link="mats"/>', "did you mean 'mast'? Known: chassis"),
        ('<child link="grip"/>', '<child link="mast"/>', "'mast' is the child of two joints, 'ma"),
        ('<link name="grip"/>', '<link name="mast"/>', "there are two links 'mast'"),
        ('<link name="grip"/>', '<link name="grip"/><link/>', 'a <link> without "name"'),
        (
            '<child link="mast"/>',
            '<child link="chassis"/>',
            "above link 'chassis' form a loop",
        ),
    ],
)
# What collides says nothing of what is only seen.
@pytest.mark.parametrize(
    "solid", ["", '<collision><geometry><sphere radius="0.2"/></geometry></collision>']
)
def test_what_cannot_be_read_is_named_in_one_line(own, old, new, message, solid):
    assert OWN.count(old) == 1
    own.write_text(OWN.replace(old, new).replace("<visual>", f"{solid}<visual>"))
    with pytest.raises(InputError, match=re.escape(message)) as refused:
        robot_of(RobotParameters(str(own), "grip"), "left", "handle")
    assert str(refused.value).startswith("robot: ")
    assert "\n" not in str(refused.value)


def test_joints_that_the_engine_cannot_read_are_locked_for_pictures(own):
    own.write_text(OWN.replace('type="revolute"', 'type="odd"').replace('lower="-1"', 'lower="a"'))
    robot = robot_of(RobotParameters(str(own), "grip"), "left", "handle")
    client = connect()
    body = load(client, robot.urdf)
    count = engine.getNumJoints(body, client)
    root = np.array(engine.getDynamicsInfo(body, -1, client)[3])  # the engine's origin
    links = {engine.getJointInfo(body, j, client)[12].decode(): j for j in range(count)}
    engine.resetBasePositionAndOrientation(body, root, (0.0, 0.0, 0.0, 1.0), client)
    places = {name: engine.getLinkState(body, j, 0, 1, client)[4] for name, j in links.items()}
    disconnect(client)
    assert set(places) == {"mast", "grip"}
    for name, place in places.items():
        assert place == pytest.approx(robot.rigid.places[name])


def test_what_is_solid_must_weigh_something():
    solid, weightless = OWN.replace("<visual>", "<collision/><visual>"), OWN.replace(HEAVY, "")
    assert lump(ElementTree.fromstring(solid)).mass == 25.0
    assert lump(ElementTree.fromstring(weightless)).mass == 5.0
    with pytest.raises(InputError, match="link 'chassis' has collision shapes but no mass"):
        lump(ElementTree.fromstring(solid.replace(HEAVY, "")))


def test_a_robot_in_grams_is_refused():
    light = OWN.replace('value="20"', 'value="0.02"').replace('value="5"', 'value="0.005"')
    with pytest.raises(InputError, match=r"weigh 0.025 kg together: it must be 1 kg or more"):
        lump(ElementTree.fromstring(light))


def test_a_missing_handle_names_the_links(own):
    with pytest.raises(InputError, match=r"no link 'gripp'; did you mean 'grip'\? Known: chassis"):
        robot_of(RobotParameters(str(own), "gripp"), "left", "handle")


@pytest.mark.parametrize("hand", ["left", "right", "both"])
def test_the_figure_loads_with_all_its_limbs(hand):
    handles = ((-0.3, 0.2, 1.0), (-0.3, -0.2, 1.0))
    body = human_body(BodyParameters(hand=hand), handles if hand == "both" else handles[:1])
    client = connect()
    figure = load(client, figure_urdf(body))
    arms = 2 * len(body.arms) + 2 - len(body.arms)
    assert engine.getNumJoints(figure, client) == 6 + arms
    disconnect(client)
