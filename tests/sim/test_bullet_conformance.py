"""What must hold for every way of building the plant: drive x grip x coupling x hand."""

import itertools
import math

import numpy as np
import pytest

from cowalk.sim import drive
from cowalk.sim.anthropometry import HANDS
from cowalk.sim.bullet import BulletPlant
from cowalk.sim.bullet_coupling import COUPLINGS
from cowalk.sim.drive import DRIVES
from cowalk.sim.grip import GRIPS
from cowalk.sim.path import Path
from cowalk.sim.plant import Rates
from cowalk.sim.world import World

WORLD = World(Path(((0, 0), (20, 0))))
OPTIONS = list(itertools.product(DRIVES, GRIPS, COUPLINGS, HANDS))
WRIST = {"turn_stiffness": (0.0, 0.0, 1.0), "turn_damping": (0.0, 0.0, 0.05)}


@pytest.fixture(params=OPTIONS, ids="-".join)
def option(request):
    wheels, grip, coupling, hand = request.param
    return {
        "drive": {"kind": wheels},
        "grip": {"kind": grip, **WRIST},
        "coupling": {"kind": coupling},
        "body": {"hand": hand},
    }


def course(step):
    return (0.8, 0.3 * math.sin(0.1 * step)), (
        2.0 * math.sin(0.3 * step),
        3.0 * math.cos(0.2 * step),
    )


def wander(plant, steps):
    rows = []
    for step in steps:
        state = plant.step(*course(step))
        rows.append([*state.pose, *state.twist, *state.human_pose, *state.wrench_on_base.flat])
    return np.array(rows)


def test_one_seed_one_run_also_from_a_saved_state(option):
    option["gait"] = {"enabled": True}
    plant, other = BulletPlant(Rates(), **option), BulletPlant(Rates(), **option)
    plant.reset(WORLD, np.random.default_rng(0))
    begun = wander(plant, range(20))
    saved = plant.save()
    first = wander(plant, range(20, 45))
    wander(plant, range(3))
    plant.restore(saved)
    assert first.tobytes() == wander(plant, range(20, 45)).tobytes(), "restored"
    # Another plant, stepped in between, begins anew and is not touched by this one.
    other.reset(WORLD, np.random.default_rng(1))
    other.step(*course(0))
    other.reset(WORLD, np.random.default_rng(0))
    again = []
    for step in range(20):
        again.append(wander(other, [step])[0])
        plant.step(*course(step))
    assert begun.tobytes() == np.array(again).tobytes(), "in another plant"
    plant.close()
    other.close()


def kinetic_energy(plant):
    """Return the energy of base, load, and of the human as one body with a trunk that turns, J."""
    total = 0.0
    for mass, inertia, state in (
        (40.0, 1.57, plant._pair.base_state[3:]),
        (8.0, 1.0, plant._pair.load_state[3:]),
        (70.0, 1.2, plant._pair.human_state[len(plant._pair.human_state) // 2 :]),
    ):
        if state:
            vx, vy, rate = state[:3]
            total += 0.5 * mass * (vx * vx + vy * vy) + 0.5 * inertia * rate * rate
    return total


def test_energy_does_not_grow_when_nobody_pushes(option):
    plant = BulletPlant(Rates(), **option)
    plant.reset(WORLD, np.random.default_rng(0))
    for _ in range(20):
        plant.step((0.8, 0.3), (5.0, -4.0))
    started = kinetic_energy(plant)
    energies = []
    for _ in range(80):
        plant.step((0.0, 0.0), (0.0, 0.0))
        energies.append(kinetic_energy(plant))
    plant.close()
    # Springs lend and take back: the largest of each half second must not grow.
    largest = np.reshape(energies, (-1, 10)).max(axis=1)
    assert started > 5.0
    assert (np.diff(largest[1:]) <= 1e-4).all()
    assert largest[-1] < 1e-3


def test_momentum_of_a_coasting_base_changes_by_the_measured_wrench(option, monkeypatch):
    monkeypatch.setattr(drive, "RANGES", {})  # no user can have a base that coasts
    option["drive"] |= {
        "slip": {
            "gain_forward": 0.0,
            "gain_sideways": 0.0,
            "gain_yaw": 0.0,
            "max_force": 0.0,
            "max_torque": 0.0,
        },
        "wheels": {"max_force": 0.0, "friction": 0.0},
    }[option["drive"]["kind"]]
    plant = BulletPlant(Rates(control=240), **option)
    before = plant.reset(WORLD, np.random.default_rng(0))
    dt, impulse, turn = 1.0 / 240.0, np.zeros(2), 0.0
    handle = np.array(plant._pair.handle[:2])
    for step in range(96):
        state = plant.step((0.0, 0.0), (6.0 * math.sin(0.05 * step), 4.0))
        force, torque = state.wrench_on_base[0, :2], state.wrench_on_base[0, 5]
        cos, sin = math.cos(state.pose[2]), math.sin(state.pose[2])
        impulse += dt * np.array([cos * force[0] - sin * force[1], sin * force[0] + cos * force[1]])
        turn += dt * (torque + handle[0] * force[1] - handle[1] * force[0])
    velocity, rate = np.array(plant._pair.base_state[3:5]), plant._pair.base_state[5]
    plant.close()
    assert before.twist == (0.0, 0.0)
    assert np.linalg.norm(impulse) > 0.2
    assert 40.0 * velocity == pytest.approx(impulse, rel=0.01, abs=0.01)
    assert 1.57 * rate == pytest.approx(turn, rel=0.01, abs=0.005)
