import math

import numpy as np
import pytest

from cowalk.sim.motion import Path
from cowalk.sim.observation import OBSTACLE_ROWS, Eyes
from cowalk.sim.world import Clearance, Corridor, Obstacle, World

PATH = Path(((0.0, 0.0), (10.0, 0.0)))


def test_clearance_is_signed_and_takes_the_nearest_body():
    world = World(PATH, obstacles=(Obstacle(3.0, 0.0, 0.5, "puddle"),))
    clearance = Clearance(world, (0.3, 0.2))
    nearest, solid = clearance((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert nearest == pytest.approx(2.0 - 0.5 - 0.2)
    assert solid == math.inf
    inside, _ = clearance((3.0, 0.1, 0.0), (0.0, 5.0, 0.0))
    assert inside == pytest.approx(0.1 - 0.5 - 0.3)


def test_walls_and_solid_obstacles_count_as_solid():
    world = World(PATH, Corridor(3.0), (Obstacle(5.0, 0.0, 0.2, "pillar"),))
    clearance = Clearance(world, (0.3,))
    assert clearance((0.0, 1.0, 0.0)) == pytest.approx((0.2, 0.2))
    assert clearance((4.0, 0.0, 0.0)) == pytest.approx((0.5, 0.5))


def test_eyes_see_their_own_obstacles_nearest_first_in_base_axes():
    world = World(
        PATH,
        obstacles=(
            Obstacle(8.0, 0.0, 0.5, seen_by=("human",)),
            Obstacle(2.0, 1.0, 0.3, seen_by=("human",)),
            Obstacle(1.0, 0.0, 0.1, seen_by=("automation",)),
        ),
    )
    rows = Eyes(world, "human").look((2.0, 0.0, math.pi / 2))
    np.testing.assert_allclose(rows[0], [1.0, 1.0, 0.0, 0.3], atol=1e-12)
    np.testing.assert_allclose(rows[1], [1.0, 0.0, -6.0, 0.5], atol=1e-12)
    assert not rows[2:].any()


def test_more_obstacles_than_rows_leaves_the_farthest_out():
    crowd = tuple(Obstacle(float(x), 0.0, 0.1) for x in range(20, 0, -1))
    rows = Eyes(World(PATH, obstacles=crowd), "human").look((0.0, 0.0, 0.0))
    np.testing.assert_allclose(rows[:, 1], np.arange(1, OBSTACLE_ROWS + 1))
