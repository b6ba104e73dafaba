"""What each seat sees: its own obstacles, in range, in sight, in base axes."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim.basics.observation import OBSTACLE_ROWS
from cowalk.sim.basics.path import Path
from cowalk.sim.world.eyes import Eyes, covering_discs
from cowalk.sim.world.footprint import Rectangle
from cowalk.sim.world.sight import Pillar, Screen, behind_pillar, behind_screen
from cowalk.sim.world.world import (
    Corridor,
    Doorway,
    Furniture,
    Obstacle,
    Pedestrian,
    SideCorridor,
    ViewRange,
    Wall,
    World,
)

PATH = Path(((0.0, 0.0), (10.0, 0.0)))
HERE, BESIDE = (0.0, 0.0, 0.0), (-0.1, -0.65, 0.0)


def seen(world, seat="human", base=HERE, human=BESIDE, time=0.0, eye=None):
    places = {"human": (0.0, 0.0, 1.64), "automation": (0.28, 0.0, 1.2)}
    rows = Eyes(world, seat, eye or places[seat]).look(base, human, time)
    return rows[rows[:, 0] > 0.0]


def test_each_seat_sees_its_own_nearest_first_in_base_axes():
    world = World(
        PATH,
        obstacles=(
            Obstacle(8.0, 0.0, 0.5, seen_by=("human",)),
            Obstacle(2.0, 1.0, 0.3, seen_by=("human",)),
            Obstacle(1.0, 0.0, 0.1, seen_by=("automation",)),
        ),
    )
    rows = seen(world, base=(2.0, 0.0, math.pi / 2))
    expected = [[1.0, 1.0, 0.0, 0.3, 0.0, 0.0], [1.0, 0.0, -6.0, 0.5, 0.0, 0.0]]
    np.testing.assert_allclose(rows, expected, atol=1e-12)


def test_more_obstacles_than_rows_leaves_the_farthest_out():
    crowd = tuple(Obstacle(float(x), 0.0, 0.1) for x in range(20, 0, -1))
    rows = seen(World(PATH, obstacles=crowd))
    np.testing.assert_allclose(rows[:, 1], np.arange(1, OBSTACLE_ROWS + 1))


PUDDLE = Obstacle(6.0, 0.0, 0.3)


@pytest.mark.parametrize(
    ("between", "hidden"),
    [
        ({"furniture": (Furniture(3.0, 0.0, 0.4, 2.0, seen_by=()),)}, True),
        ({"furniture": (Furniture(3.0, 1.4, 0.4, 2.0, seen_by=()),)}, False),
        ({"furniture": (Furniture(8.0, 0.0, 0.4, 2.0, seen_by=()),)}, False),
        ({"walls": (Wall((3.0, -4.0), (3.0, 4.0)),)}, True),
        ({"corridor": Corridor(4.0, (Doorway(3.0, 1.0, 1.4),))}, True),
        ({"corridor": Corridor(4.0, (Doorway(3.0, 1.0, 0.0),))}, False),
        (
            {"pedestrians": (Pedestrian(((2.0, 0.0), (2.0, 5.0)), start_time=1.0, radius=0.4),)},
            True,
        ),
    ],
)
def test_what_stands_between_hides(between, hidden):
    rows = seen(World(PATH, obstacles=(PUDDLE,), **between), "automation")
    assert (not np.any(rows[:, 3] == 0.3)) == hidden


def test_a_pedestrian_who_steps_aside_uncovers():
    walker = Pedestrian(((2.0, 0.0), (2.0, 5.0)), speed=1.0, radius=0.4)
    world = World(PATH, obstacles=(PUDDLE,), pedestrians=(walker,))
    assert not np.any(seen(world, "automation", time=0.0)[:, 3] == 0.3)
    assert np.any(seen(world, "automation", time=2.0)[:, 3] == 0.3)


def test_the_edge_of_a_thing_is_enough():
    box = Furniture(3.0, 0.5, 0.4, 1.1, seen_by=())  # from y = -0.05: hides the middle alone
    assert len(seen(World(PATH, obstacles=(PUDDLE,), furniture=(box,)), "automation")) == 1
    wider = Furniture(3.0, 0.5, 0.4, 1.6, seen_by=())  # from y = -0.3
    assert not len(seen(World(PATH, obstacles=(PUDDLE,), furniture=(wider,)), "automation"))


def test_the_two_seats_look_from_where_they_are():
    # A cupboard on the left hides the robot's view of what the human, further right, sees.
    box = Furniture(2.0, 0.2, 0.4, 0.8, seen_by=())
    world = World(PATH, obstacles=(Obstacle(4.0, 0.25, 0.2),), furniture=(box,))
    assert not len(seen(world, "automation"))
    assert not len(seen(world, "human", human=(0.0, 0.3, 0.0)))
    assert len(seen(world, "human", human=(0.0, -2.0, 0.0)))


def test_around_the_corner_of_a_side_corridor():
    corridor = Corridor(3.0, side_corridors=(SideCorridor(6.0, 2.0, "left", 5.0),))
    world = World(PATH, corridor, (Obstacle(6.0, 4.5, 0.2),))
    assert not len(seen(world))
    assert len(seen(world, base=(6.0, 0.0, 0.0), human=(5.9, -0.65, 0.0)))


def test_furniture_hides_what_is_behind_and_is_seen_itself():
    box = Furniture(3.0, 0.0, 0.6, 0.6)
    rows = seen(World(PATH, obstacles=(PUDDLE,), furniture=(box,)), human=HERE)
    np.testing.assert_allclose(rows[0, :4], [1.0, 3.0, 0.0, math.hypot(0.3, 0.3)])
    assert len(rows) == 1


def test_a_doorway_is_seen_by_its_posts():
    rows = seen(World(PATH, Corridor(4.0, (Doorway(5.0, 1.4, 0.2),))))
    posts = sorted(rows[:, 2])
    assert posts == pytest.approx([0.2 - 0.75, 0.2 + 0.75])
    np.testing.assert_allclose(rows[:, [1, 3]], [[5.0, 0.05]] * 2)


def test_range_is_counted_from_the_eye_to_the_edge():
    world = World(PATH, obstacles=(PUDDLE,), view_range=ViewRange(human=5.9, automation=5.4))
    assert len(seen(world, "human", human=(0.0, 0.0, 0.0)))
    assert not len(seen(world, "human", human=(-0.3, 0.0, 0.0)))
    assert not len(seen(world, "automation"))
    assert len(seen(world, "automation", base=(0.1, 0.0, 0.0)))


def test_pedestrians_velocity_is_over_ground_in_base_axes():
    world = World(PATH, pedestrians=(Pedestrian(((4.0, 0.0), (4.0, 3.0)), 1.5),))
    (row,) = seen(world, base=(0.0, 0.0, math.pi / 2), time=1.0)
    np.testing.assert_allclose(row, [1.0, 1.5, -4.0, 0.22, 1.5, 0.0], atol=1e-12)


@given(
    st.floats(0.05, 3.0),
    st.floats(0.05, 3.0),
    st.floats(-4.0, 4.0),
    st.floats(0.0, 1.0),
    st.floats(0.0, 1.0),
)
def test_discs_cover_a_rectangle_and_little_more(half_length, half_width, yaw, u, v):
    discs = np.array(covering_discs(Rectangle(1.0, -2.0, half_length, half_width, yaw)))
    point = np.array(((2 * u - 1) * half_length, (2 * v - 1) * half_width))
    cos, sin = math.cos(yaw), math.sin(yaw)
    place = (1.0 + cos * point[0] - sin * point[1], -2.0 + sin * point[0] + cos * point[1])
    away = np.hypot(*(discs[:, :2] - place).T) - discs[:, 2]
    assert away.min() <= 1e-9
    assert discs[:, 2].max() <= math.sqrt(2.0) * min(half_length, half_width) + 1e-9


points = st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(0.0, 3.0))


def lowest_inside(eye, point, inside):
    """How high the line is at its lowest above a footprint, and how deep it goes in, sampled."""
    way = np.array(eye) + np.linspace(0.0, 1.0, 4001)[:, None] * np.subtract(point, eye)
    depth = inside(way[:, :2] - (0.3, -0.2))
    return way[depth < 0.0, 2].min(initial=math.inf), depth.min()


def holds(hides, eye, point, occluder, inside):
    """A line is hidden that passes above the footprint lower than the occluder is high."""
    lowest, depth = lowest_inside(eye, point, inside)
    if abs(depth) > 0.01 and abs(lowest - occluder.height) > 0.01:  # sampling decides no closer
        assert (hides(eye, point, [occluder]) is occluder) == (lowest < occluder.height)
        assert not hides(eye, point, [occluder], itself=0)


@given(
    points,
    points,
    st.floats(0.1, 2.0),
    st.floats(0.1, 2.0),
    st.floats(-3.2, 3.2),
    st.floats(0.1, 3.0),
)
def test_a_line_through_a_box_is_one_with_a_point_inside(eye, point, length, width, yaw, height):
    cos, sin = math.cos(yaw), math.sin(yaw)

    def inside(way):
        along, across = np.abs(way @ (cos, sin)) - length, np.abs(way @ (-sin, cos)) - width
        return np.maximum(along, across)

    holds(behind_screen, eye, point, Screen(0, 0.3, -0.2, cos, sin, length, width, height), inside)


@given(points, points, st.floats(0.1, 2.0), st.floats(0.1, 3.0))
def test_a_line_through_a_cylinder_is_one_with_a_point_inside(eye, point, radius, height):
    pillar = Pillar(0, 0.3, -0.2, radius, height)
    holds(behind_pillar, eye, point, pillar, lambda way: np.hypot(*way.T) - radius)


ACROSS = {"x": 3.0, "y": 0.0, "length": 0.4, "width": 2.0, "seen_by": ()}
TALL = Furniture(6.0, 0.0, 0.3, 0.3, kind="cupboard")


@pytest.mark.parametrize(
    ("kind", "behind", "sees"),
    [
        # From 1.64 m the line over the table's far edge is 0.53 m high at x = 4, 0 at x = 5.9 m.
        ("table", Obstacle(4.0, 0.0, 0.2, "bin", height=0.4), False),
        ("table", Obstacle(4.0, 0.0, 0.2, "bin", height=0.6), True),
        ("table", Obstacle(4.0, 0.0, 0.2), False),  # a puddle behind it
        ("table", Obstacle(8.0, 0.0, 0.2), True),  # and one that is far enough behind it
        ("table", TALL, True),
        ("table", Pedestrian(((6.0, 0.0), (7.0, 0.0)), start_time=9.0), True),
        ("cupboard", TALL, False),
        ("cupboard", Furniture(6.0, 0.0, 0.3, 0.3, height=2.4), True),
        ("cupboard", Pedestrian(((6.0, 0.0), (7.0, 0.0)), start_time=9.0), False),
        ("wall", Pedestrian(((6.0, 0.0), (7.0, 0.0)), start_time=9.0), False),
    ],
)
def test_one_looks_over_what_is_lower_at_what_is_tall_enough(kind, behind, sees):
    between = {"walls": (Wall((3.0, -1.0), (3.0, 1.0)),)}
    if kind != "wall":
        between = {"furniture": (Furniture(**ACROSS, kind=kind),)}
    section = {Obstacle: "obstacles", Furniture: "furniture", Pedestrian: "pedestrians"}
    name = section[type(behind)]
    world = World(PATH, **(between | {name: (*between.get(name, ()), behind)}))
    rows = seen(world, human=(0.0, 0.0, 0.0))
    assert np.any(np.abs(rows[:, 2]) < 0.01) == sees


def test_a_tall_person_sees_over_what_hides_from_a_child_and_a_low_camera():
    counter = Furniture(**ACROSS, height=1.2)
    world = World(PATH, furniture=(counter, TALL))
    # From h to the cupboard's 1.8 m, above the counter's near edge at h + (1.8 - h) 2.8 / 6.
    for height, sees in ((1.87, True), (0.70, True), (0.66, False), (0.3, False)):
        assert bool(len(seen(world, human=HERE, eye=(0.0, 0.0, height)))) == sees


def test_heights_that_are_not_given_are_those_of_the_kind_and_are_written_out():
    assert Furniture(0.0, 0.0, 1.0, 1.0, kind="cupboard").height == 1.8
    assert Furniture(0.0, 0.0, 1.0, 1.0, kind="cupboard", height=1.1).top == 1.1
    assert Furniture(0.0, 0.0, 1.0, 1.0).top == Obstacle(0.0, 0.0, 0.1, "crate").top == 0.8
    assert Obstacle(0.0, 0.0, 0.1).top == 0.0


def test_eyes_go_with_the_bodies():
    world = World(PATH, obstacles=(Obstacle(3.0, 0.0, 0.2),), view_range=ViewRange(1.0, 1.0))
    turned = (3.0, -1.5, math.pi / 2)
    assert not len(seen(world, "automation", base=turned, eye=(0.0, 0.0, 1.0)))
    assert len(seen(world, "automation", base=turned, eye=(0.6, 0.0, 1.0)))
    assert len(seen(world, "human", human=turned, eye=(0.6, 0.0, 1.0)))
    assert not len(seen(world, "human", human=turned, eye=(0.0, 0.6, 1.0)))
