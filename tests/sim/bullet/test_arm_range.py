"""The ends of an arm's range: soft tissue, not a stop, meets whoever sways a lot."""

import itertools

import numpy as np
import pytest

from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.arm import ELBOW_RANGE, arm_of, end_torque
from cowalk.sim.body.gait import growth
from cowalk.sim.bullet.plant import MAX_HELD, BulletPlant
from cowalk.sim.world.world import World

WORLD = World(Path(((0, 0), (60, 0))))
# Feet that never slide: such a sway takes more than shoes hold.
RELAXED = {"hand_stiffness": 50.0, "hand_damping": 5.0, "traction": 10.0}
FIRM = {"hand_stiffness": 100.0, "hand_damping": 10.0, "traction": 10.0}


SWAYS = {"usual": (0.042, 0.067), "wide": (0.11, 0.09), "widest": (0.12, 0.115)}
"""Fore-aft and lateral, peak to peak, m: the median person's at 0.8 m/s, and beyond all of them."""


def walk(speed, rate, sway, hand="left", walker=RELAXED, drive="slip"):
    """Return the force over three seconds, after two to settle, and the joints' excess, rad."""
    side = {"left": 1.0, "right": -1.0, "both": 0.0}[hand]  # who walks outside walks faster
    (ahead, aside), (along, across) = SWAYS[sway], growth(speed + 0.65 * side * rate)
    plant = BulletPlant(
        Rates(),
        walker=walker,
        gait={"enabled": True, "fore_aft": ahead / along, "lateral": aside / across},
        body={"hand": hand},
        drive={"kind": drive},
    )
    plant.reset(WORLD, np.random.default_rng(0))
    force, excess = [], []
    for step in range(100):
        state = plant.step((speed, rate), (0.0, 0.0))
        if step >= 40:
            force.append(state.force_on_base)
        human = np.array(plant._pair.human_state[3 : len(plant._pair.human_state) // 2])
        free = np.array([r for arm in plant._pair.body.arms for r in arm.free]).T
        excess.append(np.maximum(free[0] - human, human - free[1]).max())
    plant.close()
    return np.concatenate(force)[:, :2], max(excess)


WALKS = [
    *((v, 0.0, s, h) for v in (0.8, 1.2) for s in SWAYS for h in ("left", "right", "both")),
    *itertools.product((0.8,), (-0.5, 0.5), ("wide", "widest"), ("left", "right")),
]


@pytest.mark.parametrize(("speed", "rate", "sway", "hand"), WALKS)
def test_the_force_stays_the_arms_however_wide_the_sway(speed, rate, sway, hand):
    force, excess = walk(speed, rate, sway, hand)
    assert np.hypot(*force.T).max() < 30.0
    assert np.hypot(*np.diff(force, axis=0).T).max() < 4.0, "N from sample to sample"
    assert excess < 0.2, "0.25 rad is where it stops"
    if sway == "usual":
        assert excess < 0.0
    elif hand != "both" and sway == "widest" and rate == 0.0:
        assert excess > 0.03, "else this shows nothing"


@pytest.mark.parametrize(
    ("walker", "drive", "most"), [(FIRM, "slip", 40.0), (RELAXED, "wheels", 30.0)]
)
def test_so_it_does_with_a_firm_arm_and_on_wheels(walker, drive, most):
    force, _ = walk(0.8, 0.0, "widest", walker=walker, drive=drive)
    assert np.hypot(*force.T).max() < most
    assert np.hypot(*np.diff(force, axis=0).T).max() < 4.0


def test_the_end_torque_starts_softly_and_only_pushes_back():
    assert end_torque(0.0, 5.0, 100.0) == 0.0
    assert end_torque(0.1, 0.0, 100.0) == pytest.approx(-1.0)
    assert end_torque(-0.1, 0.0, 100.0) == pytest.approx(1.0)
    assert end_torque(0.1, 2.0, 100.0) == pytest.approx(-1.3)
    assert end_torque(-0.1, -2.0, 100.0) == pytest.approx(1.3)
    assert end_torque(0.1, -20.0, 100.0) == 0.0


@pytest.mark.parametrize("grip_height", [0.95, 1.04])
@pytest.mark.parametrize("height", [1.2, 1.5, 1.75, 2.0])
def test_held_forces_do_not_shake_an_arm_at_its_end(height, grip_height):
    """An arm that nothing else holds or damps, flung into its end: it bounces, and gains nothing.

    With the inertia of the lighter joint while the other is free, at any elbow angle.
    """
    arm = arm_of(BodyParameters(height, 22.0 * height**2), "left", grip_height)
    lightest = min(
        1.0 / np.linalg.inv(arm.inertia(0.0, elbow)[0]).diagonal().max()
        for elbow in np.linspace(*ELBOW_RANGE, 30)
    )
    step = 1.0 / 240.0
    for flung in (0.1, 0.5, 2.0, 6.0):
        beyond, rate = 0.0, flung
        while beyond >= 0.0:
            torque = end_torque(beyond, rate, arm.end_stiffness)
            for _ in range(MAX_HELD):
                rate += step * torque / lightest
                beyond += step * rate
        assert -flung < rate < 0.0
