"""Pedestrians: where they are is a function of time."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim import parallel_env
from cowalk.sim.basics.path import Path
from cowalk.sim.plant.registry import PLANTS
from cowalk.sim.world.world import Pedestrian, World

CORNER = Pedestrian(((0.0, 0.0), (3.0, 0.0), (3.0, 4.0)), speed=2.0, start_time=1.0)


@pytest.mark.parametrize(
    ("time", "state"),
    [
        (0.0, (0.0, 0.0, 0.0, 0.0)),
        (1.0, (0.0, 0.0, 0.0, 0.0)),
        (2.0, (2.0, 0.0, 2.0, 0.0)),
        (3.0, (3.0, 1.0, 0.0, 2.0)),
        (4.5, (3.0, 4.0, 0.0, 0.0)),
        (99.0, (3.0, 4.0, 0.0, 0.0)),
    ],
)
def test_they_wait_walk_turn_and_stop(time, state):
    assert CORNER.state(time) == pytest.approx(state)


def test_back_and_forth():
    walker = Pedestrian(((0.0, 0.0), (2.0, 0.0)), speed=1.0, back_and_forth=True)
    assert walker.state(1.5) == pytest.approx((1.5, 0.0, 1.0, 0.0))
    assert walker.state(2.5) == pytest.approx((1.5, 0.0, -1.0, 0.0))
    assert walker.state(4.5) == pytest.approx((0.5, 0.0, 1.0, 0.0))


@given(
    st.floats(0.0, 60.0),
    st.floats(1e-4, 0.5),
    st.booleans(),
    st.lists(st.tuples(st.floats(-5, 5), st.floats(-5, 5)), min_size=2, max_size=5),
)
def test_nobody_is_faster_than_their_speed(time, step, back_and_forth, points):
    if any(math.dist(a, b) < 1e-3 for a, b in pairwise(points)):
        return
    walker = Pedestrian(tuple(points), 1.3, 2.0, back_and_forth)
    x, y, *velocity = walker.state(time)
    to_x, to_y, *_ = walker.state(time + step)
    assert math.hypot(to_x - x, to_y - y) <= 1.3 * step + 1e-9
    speed = math.hypot(*velocity)
    assert speed == pytest.approx(1.3) or speed == 0.0


@pytest.mark.parametrize("plant", PLANTS.names())
def test_every_episode_sees_them_at_the_same_place_at_the_same_time(plant):
    world = World(
        Path(((0.0, 0.0), (10.0, 0.0))), pedestrians=(Pedestrian(((6.0, 3.0), (6.0, -3.0)), 1.0),)
    )
    env = parallel_env(world, plant=plant, duration=2.0, start="standing")
    seen = []
    for seed in (1, 2):
        observations, _ = env.reset(seed=seed)
        rows = [observations["automation"]["obstacles"][0]]
        while env.agents:
            observations, *_ = env.step({"human": np.zeros(2), "automation": np.zeros(2)})
            rows.append(observations["automation"]["obstacles"][0])
        seen.append(np.array(rows))
    env.close()
    np.testing.assert_array_equal(*seen)
    times = np.arange(len(seen[0])) * 0.05
    np.testing.assert_allclose(seen[0][:, 2], 3.0 - times, atol=1e-4)
    np.testing.assert_allclose(seen[0][1:, 4:], [[0.0, -1.0]] * (len(times) - 1), atol=1e-4)
