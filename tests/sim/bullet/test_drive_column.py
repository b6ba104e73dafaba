"""What the plant says of its drive, against the momentum of the base."""

import math
from itertools import pairwise

import numpy as np
import pytest

from cowalk.sim import Path, Rates, World
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.unicycle.plant import UnicyclePlant

WORLD = World(Path(((0, 0), (20, 0))))


def walked(plant, steps=60):
    """Return the states of a push, forward and to the left, against a twist that comes and goes."""
    plant.reset(WORLD, np.random.default_rng(0))
    states = []
    for step in range(steps):
        force = 8.0 * math.sin(0.1 * step), 5.0
        states.append(plant.step((0.4 * math.sin(0.05 * step), 0.3), force))
    return states


def test_drive_and_hand_together_change_the_momentum_of_the_base():
    plant = BulletPlant(Rates())
    states = walked(plant)
    inertia = 1.57  # about its origin, which is its centre of mass
    x, y, _ = plant.handle
    plant.close()
    for before, after in pairwise(states[10:]):
        hand = after.wrench_on_base.mean(axis=0)
        force, torque = after.drive
        forward = after.twist[0] - before.twist[0]
        # Turning, the base slips sideways by millimetres a second: v omega adds little.
        assert force + hand[0] == pytest.approx(40.0 * forward / 0.05, abs=0.3)
        about_origin = torque - y * force
        turning = inertia * (after.twist[1] - before.twist[1]) / 0.05
        by_hand = x * hand[1] - y * hand[0] + hand[5]
        assert about_origin + by_hand == pytest.approx(turning, abs=0.1)


def test_a_push_along_the_base_has_no_lever_about_the_point_beside_the_handle():
    plant = BulletPlant(Rates())
    plant.reset(WORLD, np.random.default_rng(0))
    states = [plant.step((0.0, 0.0), (8.0, 0.0)) for _ in range(60)]
    plant.close()
    force, torque = states[-1].drive
    assert force == pytest.approx(-8.0, abs=0.2)
    assert abs(torque) < 0.05 * abs(force) * 0.3


def test_it_is_not_known_at_a_reset_on_wheels_or_without_bodies():
    plant = BulletPlant(Rates())
    assert all(map(math.isnan, plant.reset(WORLD, np.random.default_rng(0)).drive))
    state = plant.step((0.4, 0.0), (0.0, 0.0))
    assert all(map(math.isfinite, state.drive))
    saved = plant.save()
    assert all(map(math.isnan, plant.restore(saved).drive))
    plant.close()
    for other in (BulletPlant(Rates(), drive={"kind": "wheels"}), UnicyclePlant(Rates())):
        other.reset(WORLD, np.random.default_rng(0))
        assert all(map(math.isnan, other.step((0.4, 0.0), (0.0, 0.0)).drive))
        other.close()
