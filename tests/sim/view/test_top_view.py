"""The drawing from above: things are where they are, in their colours."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from cowalk.sim.basics.path import Path
from cowalk.sim.plant.discs import PLAIN_BODIES
from cowalk.sim.plant.protocol import PlantState
from cowalk.sim.view import top_view as topview
from cowalk.sim.view.top_view import BASE, FLOOR, FORCE, HUMAN, LOAD, PASSER, PUDDLE, SOLID, WALL
from cowalk.sim.world.outline import Bodies, across, rectangle
from cowalk.sim.world.world import (
    Corridor,
    Doorway,
    Furniture,
    Obstacle,
    Pedestrian,
    SideCorridor,
    World,
)

WORLD = World(
    Path(((0, 0), (10, 0))),
    Corridor(3.0),
    (Obstacle(3.0, 0.3, 0.5), Obstacle(2.5, -1.0, 0.3, "crate")),
)


def state(force=(0.0, 0.0), theta=0.0):
    wrench = np.array([[*force, 0.0, 0.0, 0.0, 0.0]])
    return PlantState((1.0, 0.0, theta), (0.8, 0.0), (0.9, -0.65, theta), wrench)


def draw(world, state, width, height, bodies=PLAIN_BODIES):
    return topview.draw(world, state, bodies, width, height)


def near(picture, colour):
    """Which pixels are of a colour."""
    return np.abs(picture / 255.0 - to_rgb(colour)).max(axis=-1) < 0.02


def where(picture, colour):
    """Mean (row, column) of the pixels of a colour, and how many there are."""
    found = near(picture, colour)
    return np.argwhere(found).mean(axis=0) if found.any() else None, found.sum()


@pytest.mark.parametrize("size", [(640, 480), (320, 180), (301, 199)])
def test_size_and_type(size):
    picture = draw(WORLD, state(), *size)
    assert picture.shape == (size[1], size[0], 3)
    assert picture.dtype == np.uint8


def test_everything_is_where_it_is():
    picture = draw(WORLD, state((0.0, 5.0)), 640, 480)
    (base_row, base_column), _ = where(picture, BASE)
    (human_row, human_column), _ = where(picture, HUMAN)
    assert human_row - base_row == pytest.approx(0.65 * 640 / 6.0, abs=8), "right is below"
    assert abs(human_column - base_column) < 25
    (solid_row, solid_column), _ = where(picture, SOLID)
    assert solid_row > base_row
    assert solid_column > base_column
    assert where(picture, WALL)[1] > 10000
    puddle = picture[240 - round(0.3 * 640 / 6), round(640 * 0.4 + 2.0 * 640 / 6)] / 255.0
    assert puddle[2] > puddle[0] + 0.2, "blue"
    assert where(picture, PUDDLE)[1] == 0, "and one sees the path through it"


@pytest.mark.parametrize(
    ("force", "theta", "direction"),
    [((5.0, 0.0), 0.0, (0, 1)), ((0.0, 5.0), 0.0, (-1, 0)), ((5.0, 0.0), np.pi / 2, (-1, 0))],
)
def test_arrow_points_where_the_base_is_pushed(force, theta, direction):
    picture = draw(WORLD, state(force, theta), 640, 480)
    arrow, pixels = where(picture, FORCE)
    assert pixels > 100
    offset = arrow - (240, 256)
    assert offset @ direction > 10
    assert abs(offset @ direction[::-1]) < 5
    assert where(draw(WORLD, state(), 640, 480), FORCE)[1] == 0


def test_doors_furniture_and_people_are_where_they_are():
    world = World(
        WORLD.path,
        Corridor(3.0, (Doorway(3.0, 1.2, 0.4),), (SideCorridor(0.0, 1.0, "left", 2.0),)),
        furniture=(Furniture(2.5, -1.2, 0.4, 0.2),),
        pedestrians=(Pedestrian(((2.0, 1.0), (2.0, -1.0)), speed=1.0),),
    )

    def at(picture, x, y):
        column, row = round((x - 1.0 + 2.4) * 640 / 6.0), round(240 - y * 640 / 6.0)
        return picture[row, column] / 255.0

    picture = draw(world, state(), 640, 480)
    for place, colour in (
        ((3.0, -0.5), WALL),
        ((3.0, 0.4), FLOOR),
        ((3.0, 1.2), WALL),
        ((0.0, 1.7), FLOOR),
        ((1.0, 1.7), WALL),
        ((2.5, -1.2), SOLID),
        ((2.15, 1.0), PASSER),
    ):
        assert at(picture, *place) == pytest.approx(to_rgb(colour), abs=0.02), place
    later = draw(world, replace(state(), time=1.5), 640, 480)
    assert at(later, 2.15, -0.5) == pytest.approx(to_rgb(PASSER), abs=0.02)


def test_open_ground_and_no_global_state():
    world = World(Path(((0, 0), (5, 5), (5, 10))), start=(1.0, 0.0, 0.0))
    assert where(draw(world, state(), 200, 150), WALL)[1] == 0
    assert (
        "matplotlib.pyplot" not in sys.modules or not sys.modules["matplotlib.pyplot"].get_fignums()
    )


def test_bodies_are_drawn_as_they_are():
    bodies = Bodies(
        {
            "base": rectangle(-0.2, 1.0, -0.2, 0.2),
            "human": across(0.45, 0.24),
            "load": rectangle(-1.0, 0.0, -0.2, 0.2, underside=0.9),
        },
        PLAIN_BODIES.eyes,
    )
    world = World(Path(((0, 0), (10, 0))))
    for theta in (0.0, np.pi / 2):
        held = replace(state(theta=theta), load_pose=(1.0, -1.2, 0.0), human_pose=(2.0, 0.9, theta))
        picture = draw(world, held, 640, 480, bodies)
        rows, columns = np.nonzero(near(picture, BASE))
        extent = np.array((np.ptp(columns), np.ptp(rows))) * 6.0 / 640
        assert extent == pytest.approx((1.2, 0.4) if theta == 0.0 else (0.4, 1.2), abs=0.05)
        rows, columns = np.nonzero(near(picture, HUMAN))
        assert (np.ptp(rows) > np.ptp(columns)) == (theta == 0.0)
        rows, columns = np.nonzero(near(picture, LOAD))
        extent = np.array((np.ptp(columns), np.ptp(rows))) * 6.0 / 640
        assert extent == pytest.approx((1.0, 0.4), abs=0.05)
