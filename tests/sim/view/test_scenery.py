"""The engine's picture shows what stands and walks in the world, where it is."""

import numpy as np
import pytest

from cowalk.sim import parallel_env
from cowalk.sim.basics.path import Path
from cowalk.sim.engine.engine import connect, disconnect, engine
from cowalk.sim.view import scenery as bullet_scenery
from cowalk.sim.view.scenery import SHIRTS, Scenery
from cowalk.sim.world.world import Corridor, Doorway, Furniture, Pedestrian, SideCorridor, World

PATH = Path(((0.0, 0.0), (10.0, 0.0)))
WALKER = Pedestrian(((4.0, 1.5), (4.0, -1.5)), speed=1.0, radius=0.3)


def boxes(world, time=0.0):
    """Return the extent of every body of the scenery: lower and upper corner."""
    client = connect()
    try:
        Scenery(client, world).show(time)
        bodies = [engine.getBodyUniqueId(n, client) for n in range(engine.getNumBodies(client))]
        places = [engine.getBasePositionAndOrientation(body, client) for body in bodies]
        shapes = [engine.getVisualShapeData(body, physicsClientId=client)[0] for body in bodies]
    finally:
        disconnect(client)
    return [
        (np.array(place), np.array(shape[3]), np.array(shape[7]))
        for (place, _), shape in zip(places, shapes, strict=True)
    ]


def test_a_doorway_is_a_gap_in_a_wall_that_one_sees():
    world = World(PATH, Corridor(3.0, (Doorway(5.0, 1.2, 0.3),)))
    pieces = [(place, size) for place, size, _ in boxes(world) if size[2] == pytest.approx(1.1)]
    spans = sorted((place[1] - size[1] / 2, place[1] + size[1] / 2) for place, size in pieces)
    assert np.ravel(spans) == pytest.approx([-1.5, -0.3, 0.9, 1.5])
    assert all(place[0] == pytest.approx(5.0) for place, _ in pieces)


def test_a_person_walks_with_all_parts():
    world = World(PATH, pedestrians=(WALKER,))
    for time, y in ((0.0, 1.5), (2.0, -0.5), (9.0, -1.5)):
        shirt = [place for place, _, colour in boxes(world, time) if np.allclose(colour, SHIRTS[0])]
        assert np.mean(shirt, axis=0)[:2] == pytest.approx((4.0, y), abs=0.02)


def test_a_side_corridor_has_a_floor(monkeypatch):
    laid = []
    monkeypatch.setattr(bullet_scenery, "lay_floor", lambda _, *edges: laid.append(edges) or [])
    boxes(World(PATH, Corridor(3.0, (), (SideCorridor(5.0, 2.0, "right", 3.0),))))
    assert laid == [((4.0, 6.0), (-4.5, -1.5)), ((-6.0, 16.0), (-1.5, 1.5))]


def test_watching_shows_somebody_who_passes():
    walker = Pedestrian(((7.0, 0.8), (7.0, -0.8)), speed=1.0)
    world = World(PATH, furniture=(Furniture(3.0, 1.0, 0.8, 0.5),), pedestrians=(walker,))
    env = parallel_env(world, render_mode="rgb_array", duration=3.0)
    env.reset(seed=0)
    pictures = [env.render()]
    for _ in range(30):
        env.step({"human": np.zeros(2), "automation": np.zeros(2)})
    pictures.append(env.render())
    env.close()
    green = [(p[..., 1].astype(int) - np.maximum(p[..., 0], p[..., 2]) > 20) for p in pictures]
    columns = [np.argwhere(mask)[:, 1].mean() for mask in green]
    assert all(mask.sum() > 50 for mask in green)
    assert columns[1] > columns[0] + 20, "to the right, as the walker goes"
