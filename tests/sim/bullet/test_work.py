"""Work at the handle, against the energy that a base takes up when nothing else acts on it."""

import math

import numpy as np
import pytest

from cowalk.sim import Path, Rates, World
from cowalk.sim.bullet.plant import BulletPlant

WORLD = World(Path(((0, 0), (20, 0))))


def pushed(rates, **options):
    """Return the work of every step, and the plant, of a push that comes and goes."""
    plant = BulletPlant(rates, **options)
    plant.reset(WORLD, np.random.default_rng(0))
    work = []
    for step in range(40):
        force = 8.0 * math.sin(0.1 * step), 5.0 * math.sin(0.23 * step)
        work.append(plant.step((0.0, 0.0), force).work)
    return np.array(work), plant


@pytest.mark.parametrize("hand", ["left", "both"])
@pytest.mark.parametrize("grip", ["rigid", "compliant"])
@pytest.mark.parametrize("coupling", ["handle", "stretcher"])
def test_it_is_the_energy_of_a_coasting_base(hand, grip, coupling, coasting):
    work, plant = pushed(
        Rates(),
        drive=coasting["slip"],
        body={"hand": hand},
        grip={"kind": grip, "turn_stiffness": (0.0, 0.0, 1.0), "turn_damping": (0.0, 0.0, 0.005)},
        coupling={"kind": coupling},
    )
    _, _, _, vx, vy, rate = plant._pair.base_state
    plant.close()
    energy = 0.5 * 40.0 * (vx * vx + vy * vy) + 0.5 * 1.57 * rate * rate
    assert energy > 0.05
    assert work.sum() == pytest.approx(energy, rel=0.01)
    assert work.min() < 0.0 < work.max() or coupling == "stretcher"


def test_it_does_not_depend_on_how_often_the_sensor_reads():
    often, plant = pushed(Rates(sensor=240))
    plant.close()
    seldom, plant = pushed(Rates(sensor=20))
    plant.close()
    np.testing.assert_array_equal(often, seldom)
