"""Distances in closed form and by the engine, and worlds that make no sense."""

import gc
import math

import numpy as np
import pytest

from cowalk.sim import parallel_env
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.path import Path
from cowalk.sim.bullet.distances import EngineClearance
from cowalk.sim.engine.engine import connect, disconnect, engine
from cowalk.sim.plant.registry import PLANTS
from cowalk.sim.world.clearance import Clearance
from cowalk.sim.world.footprint import walls
from cowalk.sim.world.outline import across, bar, disc, rectangle
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

PATH = Path(((0.0, 0.0), (20.0, 0.0)))
RICH = World(
    PATH,
    Corridor(3.6, (Doorway(6.0, 1.5, 0.2),), (SideCorridor(12.0, 2.0, "left", 4.0),)),
    (Obstacle(9.0, -0.75, 0.35), Obstacle(4.0, 0.5, 0.2, "pillar")),
    furniture=(Furniture(15.0, 1.0, 2.0, 0.6, 0.4),),
    pedestrians=(Pedestrian(((18.0, 1.0), (3.0, -1.0)), 1.2),),
    walls=(Wall((0.0, 5.0), (3.0, 8.0)),),
)


def discs(*radii):
    return [*enumerate(map(disc, radii))]


@pytest.fixture(params=[Clearance, EngineClearance])
def measure(request):
    made = []

    def build(world, *radii):
        made.append(request.param(world, discs(*radii)))

        def measured(time, *places):
            return made[-1](time, *((*place[:2], 0.0) for place in places))

        return measured

    yield build
    for clearance in made:
        if isinstance(clearance, EngineClearance):
            clearance.close()


NEAR = {"abs": 1e-3}


def test_distance_to_a_puddle_is_signed_and_the_nearest_bodys(measure):
    clearance = measure(World(PATH, obstacles=(Obstacle(3.0, 0.0, 0.5, "puddle"),)), 0.3, 0.2)
    nearest, touching = clearance(0.0, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert nearest == pytest.approx(2.0 - 0.5 - 0.2, **NEAR)
    assert not touching
    inside, touching = clearance(0.0, (3.0, 0.1, 0.0), (0.0, 5.0, 0.0))
    assert inside == pytest.approx(0.1 - 0.5 - 0.3, **NEAR)
    assert not touching, "a puddle is not solid"


def test_open_ground_is_infinitely_clear(measure):
    assert measure(World(PATH), 0.3, 0.2)(0.0, (1.0, 0.0), (2.0, 0.0)) == (math.inf, False)


def test_walls_and_pillars_are_solid(measure):
    clearance = measure(World(PATH, Corridor(3.0), (Obstacle(5.0, 0.0, 0.2, "pillar"),)), 0.3)
    assert clearance(0.0, (0.0, 1.0, 0.0)) == (pytest.approx(0.2, **NEAR), False)
    assert clearance(0.0, (4.0, 0.0, 0.0)) == (pytest.approx(0.5, **NEAR), False)
    assert clearance(0.0, (0.0, -1.25, 0.0)) == (pytest.approx(-0.05, **NEAR), True)
    assert clearance(0.0, (5.0, 0.4, 0.0)) == (pytest.approx(-0.1, **NEAR), True)


def test_a_turned_box_by_its_face_its_corner_and_its_inside(measure):
    yaw = math.pi / 6
    clearance = measure(World(PATH, furniture=(Furniture(5.0, 1.0, 2.0, 0.8, yaw),)), 0.3)
    along, across = (
        np.array((math.cos(yaw), math.sin(yaw))),
        np.array((-math.sin(yaw), math.cos(yaw))),
    )
    centre = np.array((5.0, 1.0))
    for place, expected in (
        (centre + 0.7 * along + 1.5 * across, 1.5 - 0.4 - 0.3),
        (centre - 2.0 * along, 1.0 - 0.3),
        (centre + (1.0 + 0.3) * along + (0.4 + 0.4) * across, 0.5 - 0.3),
        (centre + 0.35 * across, -0.05 - 0.3),
    ):
        nearest, touching = clearance(0.0, tuple(place))
        assert nearest == pytest.approx(expected, **NEAR)
        assert touching == (expected < 0.0)


def test_a_doorway_is_open_where_it_says(measure):
    clearance = measure(World(PATH, Corridor(4.0, (Doorway(6.0, 1.4, 0.3),))), 0.3)
    assert clearance(0.0, (6.0, 0.3)) == (pytest.approx(0.7 - 0.3, **NEAR), False)
    assert clearance(0.0, (6.0, 0.9)) == (pytest.approx(0.1 - 0.3, **NEAR), True)
    assert clearance(0.0, (5.0, -1.0)) == (pytest.approx(0.95 - 0.3, **NEAR), False)


def test_a_side_corridor_can_be_entered(measure):
    clearance = measure(
        World(PATH, Corridor(3.0, side_corridors=(SideCorridor(8.0, 2.0, "right", 3.0),))), 0.3
    )
    assert clearance(0.0, (8.0, -1.55)) == (pytest.approx(1.0 - 0.3, **NEAR), False)
    assert clearance(0.0, (8.0, -3.9)) == (pytest.approx(0.6 - 0.3, **NEAR), False)
    assert clearance(0.0, (8.9, -3.0)) == (pytest.approx(0.1 - 0.3, **NEAR), True)
    assert clearance(0.0, (8.0, 1.3)) == (pytest.approx(0.2 - 0.3, **NEAR), True)


def test_pedestrians_come_nearer(measure):
    world = World(PATH, pedestrians=(Pedestrian(((10.0, 0.0), (0.0, 0.0)), 1.0, radius=0.25),))
    clearance = measure(world, 0.3)
    gaps = [clearance(time, (4.0, 0.0)) for time in (0.0, 3.0, 5.4, 5.5)]
    assert [gap for gap, _ in gaps] == pytest.approx([5.45, 2.45, 0.05, -0.05], **NEAR)
    assert [touching for _, touching in gaps] == [False, False, False, True]


LYING = bar((0.0, 0.2), (0.3, 0.35), 0.04, 0.9)  # over puddle and pillar's neighbours alike


@pytest.mark.parametrize(
    "parts",
    [discs(0.28, 0.22), [(0, disc(0.28)), (1, across(0.45, 0.24)), (1, LYING)]],
    ids=["discs", "capsules"],
)
def test_closed_form_and_engine_measure_alike_within_a_millimetre(parts):
    rng = np.random.default_rng(5)
    exact, engine = Clearance(RICH, parts), EngineClearance(RICH, parts)
    base, touched = np.array([0.0, 0.0]), 0
    for step in range(1500):
        # Wander in small steps, as a run does, and jump now and then, as a reset does.
        jump = step % 50 == 0
        base = rng.uniform((-2, -1.9), (22, 6)) if jump else base + rng.normal(0.0, 0.05, 2)
        human = base + np.array((-0.1, -0.65))
        poses = (*base, 0.3), (*human, rng.uniform(-3.0, 3.0))
        nearest, touching = exact(0.05 * step, *poses)
        by_engine, engine_touching = engine(0.05 * step, *poses)
        assert by_engine == pytest.approx(nearest, abs=1e-3)
        assert touching == engine_touching or abs(nearest) < 1e-3
        touched += touching
    assert 0 < touched < 1500
    engine.close()


def test_closed_form_refuses_what_is_neither_disc_nor_capsule():
    with pytest.raises(InputError, match="outline of 4 discs"):
        Clearance(RICH, [(0, rectangle(-0.3, 0.3, -0.2, 0.2))])


def test_no_two_walls_overlap_and_the_corridor_goes_on():
    found = walls(RICH)
    spans = [(wall.x - wall.half_length, wall.x + wall.half_length, wall.y) for wall in found]
    for n, (begin, end, y) in enumerate(spans):
        for other_begin, other_end, other_y in spans[n + 1 :]:
            apart = begin >= other_end - 1e-9 or other_begin >= end - 1e-9
            assert apart or abs(y - other_y) > 0.04
    assert min(span[0] for span in spans) < -40.0
    assert max(span[1] for span in spans) > 60.0


@pytest.mark.parametrize("plant", PLANTS.names())
@pytest.mark.parametrize(
    "thing",
    [
        {"furniture": (Furniture(2.0, 0.0, 0.5, 0.5),)},
        {"furniture": (Furniture(2.0, -1.1, 0.3, 0.6),)},  # in the human's way alone
        {"pedestrians": (Pedestrian(((4.0, 0.0), (0.0, 0.0)), 0.5),)},
        {"walls": (Wall((2.0, -1.0), (2.0, 1.0)),)},
        {"corridor": Corridor(4.0, (Doorway(2.0, 0.6, 1.5),))},
    ],
)
def test_running_into_something_solid_ends_the_episode(plant, thing):
    env = parallel_env(World(PATH, **thing), plant=plant, duration=6.0)
    env.reset(seed=0)
    terminated, infos = {}, {}
    while env.agents:
        _, _, terminated, _, infos = env.step(
            {"human": np.zeros(2), "automation": np.array([0.8, 0.0])}
        )
    env.close()
    assert infos["human"]["collision"]
    assert terminated["human"]
    assert -0.1 < infos["human"]["clearance"] < 0.0


def test_distances_share_an_engine_world_and_do_not_see_each_other():
    world = World(PATH, obstacles=(Obstacle(3.0, 0.0, 0.5, "pillar"),))
    stays = EngineClearance(world, discs(0.3))
    for _ in range(30):
        full, empty = EngineClearance(world, discs(0.3)), EngineClearance(World(PATH), discs(0.3))
        assert full(0.0, (1.0, 0.0, 0.0))[0] == pytest.approx(1.2, **NEAR)
        assert empty(0.0, (1.0, 0.0, 0.0))[0] == math.inf
        assert full._client == empty._client == stays._client
        for clearance in (full, empty, full):
            clearance.close()
        assert stays(0.0, (2.0, 0.0, 0.0))[0] == pytest.approx(0.2, **NEAR)
    bodies = engine.getNumBodies(stays._client)
    stays.close()
    assert engine.getNumBodies(stays._client) < bodies


def test_who_is_not_closed_is_freed_with_the_last_reference():
    env = parallel_env()
    env.reset(seed=0)
    client = env.plant._pair.client
    distances = env._distances._client
    bodies = engine.getNumBodies(distances)
    assert engine.isConnected(client)
    del env
    gc.collect()
    assert not engine.isConnected(client)
    assert engine.getNumBodies(distances) < bodies


def test_a_client_that_was_given_out_again_is_not_freed_with_its_former_owner():
    env = parallel_env()
    client = env.plant._pair.client
    engine.disconnect(client)
    other = connect()
    assert other == client
    del env
    gc.collect()
    assert engine.isConnected(other)
    disconnect(other)


def test_a_bullet_plant_measures_by_the_engine_and_the_unicycle_in_closed_form():
    for plant, kind in (("bullet", EngineClearance), ("unicycle", Clearance)):
        env = parallel_env(plant=plant)
        assert isinstance(env._distances, kind)
        env.close()


@pytest.mark.parametrize(
    ("thing", "kwargs", "named"),
    [
        (Obstacle, {"x": 0, "y": 0, "radius": 0.0}, "radius = 0.0 m"),
        (Obstacle, {"x": 0, "y": 0, "radius": 1.0, "seen_by": ("robot",)}, "seen_by"),
        (Furniture, {"x": 0, "y": 0, "length": -1.0, "width": 1.0}, "length = -1.0 m"),
        (Wall, {"start": (1.0, 2.0), "end": (1.0, 2.0)}, "end"),
        (Corridor, {"width": 0.0}, "width"),
        (Corridor, {"width": 2.0, "doorways": (Doorway(1.0, 1.5, 0.5),)}, "doorways.0 reaches"),
        (
            Corridor,
            {"width": 2.0, "side_corridors": (SideCorridor(1.0, 2.0), SideCorridor(2.5, 1.5))},
            "x = 1 and 2.5 m, left, overlap",
        ),
        (Pedestrian, {"waypoints": ((0.0, 0.0),)}, "waypoints"),
        (Pedestrian, {"waypoints": ((0.0, 0.0), (0.0, 0.0))}, "waypoints"),
        (Pedestrian, {"waypoints": ((0.0, 0.0), (1.0, 0.0)), "speed": 0.0}, "speed"),
        (Pedestrian, {"waypoints": ((0.0, 0.0), (1.0, 0.0)), "start_time": -1.0}, "start_time"),
        (ViewRange, {"human": 0.0}, "human = 0.0 m"),
    ],
)
def test_nonsense_is_refused(thing, kwargs, named):
    with pytest.raises(InputError, match=named.replace(".", r"\.")):
        thing(**kwargs)


@pytest.mark.parametrize(
    ("build", "at"),
    [
        (lambda: Obstacle(math.nan, 0.0, 0.3), ("x",)),
        (lambda: Furniture(1.0, 2.0, 1.0, 1.0, math.inf), ("yaw",)),
        (lambda: Wall((0.0, 1.0), (3.0, math.nan)), ("end",)),
        (lambda: Doorway(-math.inf, 1.0), ("x",)),
        (lambda: Path(((0.0, 0.0), (math.nan, 1.0))), ("points", 1, 0)),
        (lambda: Pedestrian(((0.0, 0.0), (1.0, 3e6))), ("waypoints", 1, 1)),
        (lambda: World(PATH, start=(0.0, math.nan, 0.0)), ("start",)),
        (lambda: World(PATH, obstacles=(Obstacle(1.0, 2.0, 0.3), 3)), ("obstacles", 1)),
        (lambda: Corridor(3e6), ("width",)),
    ],
)
def test_a_place_that_is_no_place_is_named(build, at):
    with pytest.raises(InputError, match="^" + ".".join(map(str, at))) as refused:
        build()
    assert refused.value.at == at
