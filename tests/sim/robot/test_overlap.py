"""A human who would stand inside the robot is refused, one who walks within its frame is not."""

import itertools
import re

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from cowalk.sim.basics.errors import InputError
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.grip import GripParameters
from cowalk.sim.body.human_body import human_body
from cowalk.sim.bullet.pair import Pair
from cowalk.sim.pair.design import PairParameters
from cowalk.sim.robot.coupling import CouplingParameters
from cowalk.sim.robot.drive import DriveParameters
from cowalk.sim.robot.overlap import TOLERANCE, refuse_overlap
from cowalk.sim.robot.robot import RobotParameters, robot_of, two_hands
from cowalk.sim.urdf.solids import Solid

ROBOT = """<robot name="own"><link name="frame"><inertial><mass value="20"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>{shapes}</link>
<link name="grip"/><joint name="grip" type="fixed"><parent link="frame"/><child link="grip"/>
<origin xyz="{grip}"/></joint></robot>"""
WAYS = {"backwards": (-1, 0), "forwards": (1, 0), "left": (0, 1), "right": (0, -1)}


def collision(shape, xyz="0 0 0"):
    return f'<collision><origin xyz="{xyz}"/><geometry>{shape}</geometry></collision>'


@pytest.fixture
def pair(tmp_path):
    """Build the pair of a usual person and a robot of given shapes, held at a place."""

    def build(shapes, grip, **body):
        file = tmp_path / "own.urdf"
        file.write_text(ROBOT.format(shapes=shapes, grip=" ".join(map(str, grip))))
        given_ = PairParameters(
            DriveParameters(),
            BodyParameters(**body),
            GripParameters(),
            CouplingParameters(),
            RobotParameters(str(file), "grip"),
        )
        Pair(given_, 1.0 / 240.0, 3).close()

    return build


BOX = collision('<box size="0.5 0.4 0.9"/>', "0 0 0.45")
CURE = re.compile(
    r"^robot\.handle = 'grip': who holds it with (?:the left hand|the right hand|both hands) "
    r"stands (\d\.\d\d) m inside the shapes of link 'frame'; move it (\d\.\d\d) m (\w+), or to "
    r"the robot's rim(?:, or hold it with the (left|right) hand)?$"
)


@pytest.mark.parametrize("hand", ["left", "right", "both"])
@pytest.mark.parametrize("grip", [(0.0, 0.0, 1.0), (0.1, 0.02, 1.0), (0.25, 0.0, 1.0)])
def test_a_handle_amid_a_box_is_refused_with_what_would_do(pair, hand, grip):
    with pytest.raises(InputError) as refused:
        pair(BOX, grip, hand=hand)
    depth, move, way, other = CURE.match(str(refused.value)).groups()
    assert depth == move
    x, y = np.add(grip[:2], np.multiply(float(move), WAYS[way]))
    pair(BOX, (x, y, grip[2]), hand=hand)
    x, y = np.add(grip[:2], np.multiply(float(move) - TOLERANCE - 0.011, WAYS[way]))
    with pytest.raises(InputError, match="inside the shapes"):
        pair(BOX, (x, y, grip[2]), hand=hand)
    if other:
        pair(BOX, grip, hand=other)


def test_the_arm_reaches_over_and_what_is_above_or_below_is_in_nobodys_way(pair):
    here = "-0.24 -0.34"  # where the person of the box's middle stands
    pair(collision('<box size="0.4 0.4 0.05"/>', f"{here} 0.03"), (0.0, 0.0, 1.0))
    pair(collision('<box size="0.4 0.4 0.1"/>', f"{here} 1.85"), (0.0, 0.0, 1.0))
    pair(collision('<box size="0.5 0.4 1.0"/>', "0 0 0.5"), (0.1, -0.2, 1.1))
    for height in (0.4, 0.9, 1.6):
        with pytest.raises(InputError, match="inside the shapes of link 'frame'"):
            pair(collision('<sphere radius="0.06"/>', f"{here} {height}"), (0.0, 0.0, 1.0))


def test_a_leaning_bar_counts_where_it_passes(pair):
    # From the floor ahead to above the head behind, where the trunk stands or beside it.
    for shape in ('<box size="0.05 0.05 2.4"/>', '<capsule radius="0.03" length="2.4"/>'):
        with pytest.raises(InputError, match="inside the shapes"):
            pair(collision(shape, '-0.24 -0.34 0.9" rpy="0 -0.5 0'), (0.0, 0.0, 1.0))
        # Its floor plan reaches the person, but only above their head.
        pair(collision(shape, '0.6 -0.34 0.9" rpy="0 -0.5 0'), (0.0, 0.0, 1.0))


BARS = (
    ((0.9, 0.04, 0.9), (-0.25, 0.34, 0.45)),
    ((0.9, 0.04, 0.9), (-0.25, -0.34, 0.45)),
    ((0.1, 0.72, 0.9), (0.2, 0.0, 0.45)),
)


def mesh(tmp_path, parts, name="frame.stl"):
    boxes = [trimesh.creation.box(size) for size, _ in parts]
    for box, (_, place) in zip(boxes, parts, strict=True):
        box.apply_translation(place)
    trimesh.util.concatenate(boxes).export(tmp_path / name)
    return collision(f'<mesh filename="{name}"/>')


@pytest.mark.parametrize("as_mesh", [False, True])
@pytest.mark.parametrize("height", [1.3, 1.75, 2.0])
def test_who_walks_between_the_bars_of_a_rollator_is_taken(pair, tmp_path, as_mesh, height):
    grip = (0.1, 0.0, 1.0 * height / 1.75)
    shapes = "".join(
        collision(f'<box size="{" ".join(map(str, s))}"/>', " ".join(map(str, p))) for s, p in BARS
    )
    shapes = mesh(tmp_path, BARS) if as_mesh else shapes
    pair(shapes, grip, hand="both", height=height)
    robot = robot_of(RobotParameters(str(tmp_path / "own.urdf"), "grip"), "both", "handle")
    place = human_body(BodyParameters(hand="both", height=height), robot.handles).place
    back, front, right, left = robot.outline.box
    assert back < place[0] < front, "the outline that the world sees is filled"
    assert right < place[1] < left
    # On a bar, and in the cross-piece ahead.
    for grip in ((0.1, 0.3, 1.0), (0.45, 0.0, 1.0)):
        with pytest.raises(InputError, match="inside the shapes of link 'frame'"):
            pair(shapes, grip, hand="both")


def test_within_a_solid_mesh_there_is_no_room(pair, tmp_path):
    # Its surface is nowhere near the trunk.
    block = mesh(tmp_path, (((3.0, 3.0, 4.0), (0.0, 0.0, 1.0)),))
    with pytest.raises(InputError, match=r"stands 1\.\d\d m inside"):
        pair(block, (0.0, 0.0, 1.0))


@given(
    st.floats(1.2, 2.2),
    st.floats(20.0, 200.0),
    st.sampled_from(["left", "right", "both"]),
    st.sampled_from(["handle", "stretcher"]),
)
@settings(max_examples=150, deadline=None)
def test_everybody_may_hold_the_robot_that_ships(height, mass, hand, coupling):
    robot = robot_of(RobotParameters(), hand, coupling)
    handles, (shift_x, shift_y) = robot.handles, (0.0, 0.0)
    if coupling == "stretcher":
        end = (-CouplingParameters(kind="stretcher").length, 0.0, robot.handle[2])
        handles, (shift_x, shift_y) = two_hands(end) if hand == "both" else (end,), robot.handle[:2]
    body = BodyParameters(height, mass, hand)
    x, y, yaw = human_body(body, handles).place
    refuse_overlap(body, (x + shift_x, y + shift_y, yaw), robot.solids, robot.handle, "handle")


def test_a_box_and_the_same_as_a_mesh_are_judged_alike():
    corners = np.array(list(itertools.product((-0.25, 0.25), (-0.2, 0.2), (0.0, 0.9))))
    faces = trimesh.convex.convex_hull(corners)
    box, solid = Solid("box", corners), Solid("box", faces.vertices, faces=faces.faces)
    judged = set()
    for x, y in itertools.product(np.linspace(-0.5, 0.5, 9), np.linspace(-0.5, 0.5, 9)):
        said = []
        for shape in (box, solid):
            try:
                refuse_overlap(BodyParameters(), (x, y, 0.0), (shape,), (0.0, 0.0, 1.0), "grip")
                said.append("")
            except InputError as error:
                said.append(str(error).partition(" m inside")[0])
        assert bool(said[0]) == bool(said[1])
        judged.add(bool(said[0]))
    assert judged == {True, False}


@pytest.mark.parametrize("aside", [-0.3, 0.4])
def test_two_hands_hold_a_bar_that_is_not_in_the_middle_from_right_behind_it(aside):
    middle, beside = (
        human_body(BodyParameters(hand="both"), two_hands((0.1, y, 1.0))) for y in (0.0, aside)
    )
    assert beside.place == pytest.approx(np.add(middle.place, (0.0, aside, 0.0)))
    assert beside.posture == pytest.approx(middle.posture)
