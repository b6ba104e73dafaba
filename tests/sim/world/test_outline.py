"""What bodies occupy: outlines from robots, people and loads, and distances from them."""

import math
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from cowalk.sim import parallel_env
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.seats import SEATS
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.human_body import trunk_outline
from cowalk.sim.bullet.distances import EngineClearance
from cowalk.sim.plant.registry import PLANTS
from cowalk.sim.robot.robot import RobotParameters, robot_of
from cowalk.sim.urdf.solids import robot_outline, robot_solids
from cowalk.sim.world.footprint import corners, furniture
from cowalk.sim.world.outline import across, disc, hull, hull_corners, rectangle
from cowalk.sim.world.world import Corridor, Furniture, Obstacle, Pedestrian, Wall, World

PATH = Path(((0.0, 0.0), (20.0, 0.0)))
OUTLINES = {
    "disc": disc(0.28),
    "trunk": across(0.45, 0.24),
    "box": rectangle(-0.5, 0.3, -0.25, 0.25),
    "drop": hull([(0.3, 0.0, 0.2), (-0.3, 0.2, 0.0), (-0.3, -0.2, 0.05), (0.0, 0.0, 0.1)]),
}


def apart(one, other):
    """Signed distance of two convex polygons: that of 0 from their Minkowski difference."""
    hull_ = ConvexHull((one[:, None] - other[None]).reshape(-1, 2))
    outside = hull_.equations[:, 2].max()
    if outside <= 0.0:
        return outside
    corner = hull_.points[hull_.vertices]
    edge = np.roll(corner, -1, axis=0) - corner
    share = np.clip(-np.sum(corner * edge, axis=1) / np.sum(edge**2, axis=1), 0.0, 1.0)
    return np.hypot(*(corner + share[:, None] * edge).T).min()


@pytest.mark.parametrize("name", OUTLINES)
def test_the_engine_measures_turned_outlines_as_geometry_does(name):
    outline = OUTLINES[name]
    box = Furniture(0.0, 0.0, 1.0, 0.6, 0.4)
    things = {
        World(PATH, furniture=(box,)): corners(furniture(box)),
        World(PATH, obstacles=(Obstacle(0.0, 0.0, 0.35, "pillar"),)): disc(0.35).polygon,
        World(PATH, walls=(Wall((-60.0, 0.0), (60.0, 0.0)),)): np.array(
            [[60.0, 0.05], [-60.0, 0.05], [-60.0, -0.05], [60.0, -0.05]]
        ),
    }
    rng = np.random.default_rng(3)
    for world, shape in things.items():
        measure = EngineClearance(world, [(0, outline)])
        pose = np.zeros(3)
        for step in range(160):
            # Small steps, as a run makes them, and leaps, as a reset does.
            leap = step % 20 == 0
            pose = rng.uniform(-1.5, 1.5, 3) if leap else pose + rng.normal(0.0, 0.04, 3)
            expected = apart(outline.at(pose), shape)
            distance, touching = measure(0.0, tuple(pose))
            assert distance == pytest.approx(expected, abs=1e-3)
            assert touching == (expected < 0.0) or abs(expected) < 1e-3
        measure.close()


def test_a_box_by_hand():
    world = World(PATH, Corridor(2.0))
    measure = EngineClearance(world, [(0, rectangle(-0.6, 0.2, -0.3, 0.3))])
    assert measure(0.0, (0.0, 0.0, 0.0))[0] == pytest.approx(0.7, abs=1e-3)
    assert measure(0.0, (0.0, 0.0, math.pi / 2))[0] == pytest.approx(0.4, abs=1e-3)
    turned = 1.0 - 0.6 * math.sin(0.5) - 0.3 * math.cos(0.5)
    assert measure(0.0, (0.0, 0.0, 0.5))[0] == pytest.approx(turned, abs=1e-3)
    measure.close()


discs = st.tuples(st.floats(-2, 2), st.floats(-2, 2), st.sampled_from([0.0, 0.1, 0.5]))


@given(st.lists(discs, min_size=3, max_size=12), st.floats(-4, 4))
def test_a_hull_holds_its_discs_and_a_turn_moves_its_edge_no_farther_than_its_swing(given_, turn):
    try:
        outline = hull(given_)
    except ValueError:
        return  # corners on a line
    edges = ConvexHull(outline.polygon).equations
    for x, y, radius in given_:
        assert (edges[:, :2] @ (x, y) + edges[:, 2]).max() + radius < 1e-3
    before, after = outline.at((0.0, 0.0, 0.0)), outline.at((0.0, 0.0, turn))
    moved = np.abs(np.hypot(*after.T).max() - np.hypot(*before.T).max())
    assert moved < 1e-9
    assert outline.reach == pytest.approx(np.hypot(*before.T).max(), abs=1e-3)
    # Support functions of two convex sets differ by their Hausdorff distance at most.
    ways = np.stack((np.cos(np.linspace(0, 7, 99)), np.sin(np.linspace(0, 7, 99))))
    apart_ = np.abs((before @ ways).max(axis=0) - (after @ ways).max(axis=0)).max()
    assert apart_ <= outline.swing * abs(turn) + 1e-3


SHAPES = """<robot name="own"><link name="chassis">{}</link><link name="mast">{}</link>
<joint name="mast" type="fixed"><parent link="chassis"/><child link="mast"/>
<origin xyz="0.5 0 0.3" rpy="0 0 1.5707963267948966"/></joint></robot>"""


def outlined(chassis, mast="", kind="collision"):
    def shape(text):
        origin, geometry = text.split("|")
        return f"<{kind}><origin {origin}/><geometry><{geometry}/></geometry></{kind}>"

    parts = (shape(text) if text else "" for text in (chassis, mast))
    return robot_outline(robot_solids(ElementTree.fromstring(SHAPES.format(*parts))))


@pytest.mark.parametrize(
    ("chassis", "mast", "box", "top"),
    [
        ('xyz="0.1 0 0.2"|box size="0.6 0.4 0.3"', "", (-0.2, 0.4, -0.2, 0.2), 0.35),
        ('|box size="0.4 0.4 0.2"', '|box size="0.2 0.6 0.2"', (-0.2, 0.8, -0.2, 0.2), 0.4),
        ('xyz="0 0.1 0.3"|sphere radius="0.2"', "", (-0.2, 0.2, -0.1, 0.3), 0.5),
        ('|cylinder radius="0.3" length="0.4"', "", (-0.3, 0.3, -0.3, 0.3), 0.2),
        (
            'rpy="0 1.5707963267948966 0"|cylinder radius="0.1" length="0.8"',
            "",
            (-0.4, 0.4, -0.1, 0.1),
            0.1,
        ),
        (
            'rpy="0 1.5707963267948966 0"|capsule radius="0.1" length="0.8"',
            "",
            (-0.5, 0.5, -0.1, 0.1),
            0.1,
        ),
    ],
)
@pytest.mark.parametrize("kind", ["collision", "visual"])
def test_a_robots_outline_is_that_of_its_shapes(chassis, mast, box, top, kind):
    outline, height = outlined(chassis, mast, kind)
    assert outline.box == pytest.approx(box, abs=2e-3)
    assert height == pytest.approx(top, abs=2e-3)


@pytest.mark.parametrize(
    ("shape", "named"),
    [
        ('|box size="0 0 1"', "no breadth"),
        ('|mesh filename="{}"', "link 'chassis': mesh '.*hull.stl': must have triangles"),
    ],
)
def test_shapes_that_are_none(tmp_path, shape, named):
    (tmp_path / "hull.stl").write_text("solid nothing")
    shape = shape.format(tmp_path / "hull.stl")
    with pytest.raises(InputError, match=named):
        outlined(shape)


MESH_ROBOT = """<robot name="own"><link name="chassis"><inertial><mass value="20"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0.1 0 0"/><geometry><mesh filename="{}" scale="2 1 1"/></geometry>
</collision></link><link name="grip"/>
<joint name="grip" type="fixed"><parent link="chassis"/><child link="grip"/>
<origin xyz="0 -0.3 1"/></joint></robot>"""


@pytest.mark.parametrize("name", ["meshes/hull.obj", "package://own/meshes/hull.obj"])
def test_a_robots_meshes_are_found_and_read(tmp_path, name):
    folder = tmp_path / "own"
    (folder / "meshes").mkdir(parents=True)
    points = [(0.2, 0.1, 0.0), (-0.2, 0.1, 0.0), (-0.2, -0.1, 0.0), (0.2, -0.1, 0.5)]
    lines = [f"v {x} {y} {z}" for x, y, z in points] + ["f 1 2 3", "f 1 3 4", "f 1 2 4", "f 2 3 4"]
    (folder / "meshes" / "hull.obj").write_text("\n".join(lines))
    (folder / "own.urdf").write_text(MESH_ROBOT.format(name))
    robot = robot_of(RobotParameters(str(folder / "own.urdf"), "grip"), "left", "handle")
    assert robot.outline.box == pytest.approx((-0.3, 0.5, -0.1, 0.1))
    assert robot.camera == pytest.approx((0.5, 0.0, 0.5)), "front of the outline, at its top"


@pytest.mark.parametrize("hand", ["left", "right", "both"])
def test_the_robot_that_ships_is_a_disc_and_sees_from_its_camera(hand):
    robot = robot_of(RobotParameters(), hand, "handle")
    assert robot.outline == disc(0.28)
    assert robot.camera == (0.12, 0.0, 1.17)
    with pytest.raises(InputError, match=r"robot\.camera: no link 'eye'"):
        robot_of(RobotParameters(camera="eye"), hand, "handle")


def test_people_are_as_broad_as_their_height_and_mass():
    usual = trunk_outline(BodyParameters()).box
    assert usual[3] == pytest.approx(0.22, abs=0.01), "half a shoulder breadth"
    assert usual[1] == pytest.approx(0.12, abs=0.01)
    tall = trunk_outline(BodyParameters(height=2.0, mass=70.0 * (2.0 / 1.75) ** 3)).box
    assert tall == pytest.approx(np.multiply(usual, 2.0 / 1.75)), "the same build, larger"
    heavy = trunk_outline(BodyParameters(mass=140.0)).box
    assert heavy == pytest.approx(np.multiply(usual, math.sqrt(2.0)))


def closeness(**plant_parameters):
    """Clearance of the pair at its start, 2.5 m from a wall to its right."""
    world = World(PATH, walls=(Wall((-30.0, -2.55), (30.0, -2.55)),))
    env = parallel_env(world, plant_parameters=plant_parameters)
    infos = env.reset(seed=0)[1]
    bodies, state = env.plant.bodies, env.plant_state
    env.close()
    return infos["human"]["clearance"], bodies, state


def test_a_heavy_person_comes_nearer_to_a_wall():
    usual, _, state = closeness()
    heavy, bodies, _ = closeness(body={"mass": 140.0})
    half = trunk_outline(BodyParameters()).box[3]
    assert usual == pytest.approx(2.5 + state.human_pose[1] - half, abs=1e-3)
    assert heavy == pytest.approx(usual - (math.sqrt(2.0) - 1.0) * half, abs=1e-3)
    assert bodies.eyes["human"][2] == pytest.approx(0.936 * 1.75)


def test_a_users_box_is_what_collides(tmp_path):
    box = '<box size="1.0 0.5 0.4"/>'
    file = tmp_path / "box.urdf"
    file.write_text(
        MESH_ROBOT.replace('<mesh filename="{}" scale="2 1 1"/>', box).replace("-0.3 1", "-0.4 1")
    )
    crate = Obstacle(2.0, 0.2, 0.1, "crate")
    env = parallel_env(
        World(PATH, obstacles=(crate,)),
        plant_parameters={"robot": {"urdf": str(file), "handle": "grip"}},
    )
    infos = env.reset(seed=0)[1]
    # From the box's front, 0.6 m ahead of its root, to the crate.
    assert infos["human"]["clearance"] == pytest.approx(2.0 - 0.6 - 0.1, abs=1e-3)
    while env.agents:
        infos = env.step({"human": np.zeros(2), "automation": np.array([0.8, 0.0])})[-1]
    x = env.plant_state.pose[0]
    env.close()
    assert infos["human"]["collision"]
    assert 1.3 <= x < 1.3 + 0.8 * 0.05 + 1e-3


def stretcher(thing, twist, steps=120):
    env = parallel_env(
        World(PATH, **thing), plant_parameters={"coupling": {"kind": "stretcher"}}, duration=10.0
    )
    env.reset(seed=0)
    infos = {}
    for _ in range(steps):
        infos = env.step({"human": np.zeros(2), "automation": np.array(twist)})[-1]
        if not env.agents:
            break
    state, bodies = env.plant_state, env.plant.bodies
    env.close()
    return infos["human"], state, bodies


def test_a_stretcher_swings_into_what_base_and_human_pass():
    # Outside the arc of the turn, beside the load, nearer to it than to either end.
    post = Obstacle(-0.9, -0.42, 0.1, "pillar")
    info, state, bodies = stretcher({"obstacles": (post,)}, (0.0, 0.5), 60)
    assert info["collision"]
    assert list(bodies.outlines) == ["base", "human", "load"]
    shape = disc(post.radius).moved((post.x, post.y, 0.0)).polygon
    gaps = [
        apart(outline.at(pose), shape)
        for outline, pose in zip(bodies.outlines.values(), state.poses, strict=True)
    ]
    assert gaps[2] < 0.0 < min(gaps[:2])
    assert info["clearance"] == pytest.approx(gaps[2], abs=1e-3)


@pytest.mark.parametrize(("height", "collides"), [(0.5, False), (1.2, True)])
def test_a_stretcher_passes_over_what_is_lower(height, collides):
    low = Obstacle(-0.9, -0.42, 0.1, "crate", height=height)
    assert stretcher({"obstacles": (low,)}, (0.0, 0.5), 60)[0]["collision"] == collides


@pytest.mark.parametrize(
    ("thing", "collides"),
    [
        ({"obstacles": (Obstacle(1.0, -0.36, 0.03, "post", height=1.2),)}, True),
        ({"obstacles": (Obstacle(1.0, -0.36, 0.03, "post", height=0.6),)}, False),
        ({"obstacles": (Obstacle(1.0, -0.36, 0.03),)}, False),
        ({"walls": (Wall((1.0, -0.36), (9.0, -0.36), 0.05),)}, True),
    ],
)
def test_nothing_as_high_as_the_arm_passes_between_the_two(thing, collides):
    env = parallel_env(World(PATH, **thing), duration=3.0)
    infos = env.reset(seed=0)[1]
    while env.agents:
        infos = env.step({"human": np.zeros(2), "automation": np.array([0.8, 0.0])})[-1]
    env.close()
    assert infos["human"]["collision"] == collides


def test_a_puddle_below_a_stretcher_is_not_touched_by_it():
    info, state, bodies = stretcher({"obstacles": (Obstacle(-1.0, 0.0, 0.1),)}, (0.0, 0.0), 1)
    base = math.hypot(1.0, 0.0) - 0.1 - 0.28
    human = apart(
        bodies.outlines["human"].at(state.human_pose), disc(0.1).moved((-1.0, 0.0, 0.0)).polygon
    )
    assert info["clearance"] == pytest.approx(min(base, human), abs=1e-3)


@pytest.mark.parametrize("plant", ["bullet", "unicycle"])
@pytest.mark.parametrize(
    ("world", "named"),
    [
        (
            World(PATH, furniture=(Furniture(0.0, 5.0, 1, 1), Furniture(0.3, 0.3, 0.5, 0.5))),
            r"the base is 0\.\d+ m inside world\.furniture\.1 \(furniture\); \[.*\] would be free",
        ),
        (
            World(PATH, Corridor(1.6)),
            r"the human .* a wall of world\.corridor \(width = 1\.6\); \[",
        ),
        (World(PATH, Corridor(1.0)), r".*: the base and the human take 1\.1\d m across"),
        (World(PATH, walls=(Wall((-1.0, -0.7), (1.0, -0.7)),)), r"the human .*walls\.0;"),
        (
            World(PATH, pedestrians=(Pedestrian(((0.0, 0.4), (3.0, 0.4))),)),
            r"the base .*pedestrians\.0;",
        ),
    ],
)
def test_a_start_in_touch_with_something_solid_is_refused(plant, world, named):
    env = parallel_env(world, plant=plant)
    with pytest.raises(
        InputError, match=rf"^world\.start = \[0\.0, 0\.0, 0\.0\]: {named}"
    ) as raised:
        env.reset(seed=0)
    env.close()
    cure = str(raised.value).partition("; [")[2].partition("]")[0]
    if cure:
        start = tuple(float(number) for number in cure.split(","))
        env = parallel_env(World(**(vars(world) | {"start": start})), plant=plant)
        assert env.reset(seed=0)[1]["human"]["clearance"] >= 0.0
        env.close()


def test_starting_in_a_puddle_is_allowed():
    env = parallel_env(World(PATH, obstacles=(Obstacle(0.0, 0.0, 0.5),)))
    assert env.reset(seed=0)[1]["human"]["clearance"] < 0.0
    env.close()


@pytest.mark.parametrize("plant", PLANTS.names())
def test_every_plant_tells_what_its_bodies_occupy_and_measures_just_that(plant):
    pillar = Obstacle(2.2, -0.9, 0.3, "pillar")
    env = parallel_env(World(PATH, obstacles=(pillar,)), plant=plant, duration=2.0)
    infos = env.reset(seed=0)[1]
    bodies = env.plant.bodies
    assert set(bodies.eyes) == set(SEATS)
    shape = disc(pillar.radius).moved((pillar.x, pillar.y, 0.0)).polygon
    while env.agents:
        poses = env.plant_state.poses
        gaps = [
            apart(outline.at(pose), shape)
            for outline, pose in zip(bodies.outlines.values(), poses, strict=True)
        ]
        gaps += [apart(arm.at(poses[1]), shape) for arm in bodies.arms]
        assert infos["human"]["clearance"] == pytest.approx(min(gaps), abs=1e-3)
        infos = env.step({"human": np.zeros(2), "automation": np.array([0.6, 0.4])})[-1]
    env.close()


def test_points_on_a_line_but_for_rounding_keep_the_ends_of_the_line():
    """Sorted by coordinates that are rounding, the ends are met in the middle."""
    line = np.array([[0.0, 0.0], [1e-44, 1.0], [2e-44, -1.0], [0.0, 0.5]])
    assert sorted(hull_corners(line)) == [1, 2]
    beside = np.concatenate((line, [[1.0, 0.0]]))
    assert sorted(hull_corners(beside)) == [1, 2, 4]
