"""What must hold for every way of building the plant: drive x grip x coupling x hand."""

import itertools
import math

import numpy as np
import pytest

from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.anthropometry import HANDS, yaw_inertia
from cowalk.sim.body.grip import GRIPS
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import engine
from cowalk.sim.robot.coupling import COUPLINGS
from cowalk.sim.robot.drive import DRIVES
from cowalk.sim.world.world import World

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


def moving_parts(client):
    """Yield mass, inertia (3,), rotation (3, 3), velocity and rate of every link and base."""
    for index in range(engine.getNumBodies(client)):
        body = engine.getBodyUniqueId(index, client)
        for link in range(-1, engine.getNumJoints(body, client)):
            mass, _, inertia, *_ = engine.getDynamicsInfo(body, link, client)
            if not mass > 0.0:  # the floor, and what carries planar joints
                continue
            if link < 0:
                _, turn = engine.getBasePositionAndOrientation(body, client)
                velocity, rate = engine.getBaseVelocity(body, client)
            else:
                state = engine.getLinkState(body, link, 1, 1, client)
                turn, velocity, rate = state[1], state[6], state[7]
            rotation = np.reshape(engine.getMatrixFromQuaternion(turn), (3, 3))
            yield mass, np.array(inertia), rotation, np.array(velocity), np.array(rate)


def kinetic_energy(plant):
    """Return the energy of everything that moves, the links of the human's arms too, J."""
    return sum(
        0.5 * mass * velocity @ velocity + 0.5 * inertia @ (rotation.T @ rate) ** 2
        for mass, inertia, rotation, velocity, rate in moving_parts(plant._pair.client)
    )


def test_the_energy_is_that_of_every_part():
    plant = BulletPlant(Rates(), gait={"enabled": True})
    plant.reset(WORLD, np.random.default_rng(0))
    for step in range(40):
        plant.step(*course(step))
    body, (_, _, *base), human = plant._pair.body, plant._pair.base_state, plant._pair.human_state
    _, vx, vy, rate = base
    expected = 0.5 * 40.0 * (vx * vx + vy * vy) + 0.5 * 1.57 * rate * rate
    # By differences: what the arm's links do follows from where its joints have been.
    before, step = np.array(human[:5]), 1e-6
    rates = np.array(human[5:])
    (arm,) = body.arms

    def centres(joints):
        x, y, yaw, shoulder, elbow = joints
        turns = yaw + np.cumsum([0.0, shoulder, elbow])
        along = np.stack((np.cos(turns), np.sin(turns)), axis=-1)
        out = [along[0], (-along[0, 1], along[0, 0])]
        joint = np.array([x, y]) + np.array(arm.shoulder) @ np.array(out)
        bend = joint + arm.upper.length * along[1]
        places = ((x, y), joint + arm.upper.centre * along[1], bend + arm.fore.centre * along[2])
        return np.array(places), turns

    (there, turned), (here, turn) = centres(before + step * rates), centres(before)
    masses = (70.0 - arm.upper.mass - arm.fore.mass, arm.upper.mass, arm.fore.mass)
    inertias = (yaw_inertia(body.parameters), arm.upper.inertia, arm.fore.inertia)
    for mass, inertia, v, w in zip(
        masses, inertias, (there - here) / step, (turned - turn) / step, strict=True
    ):
        expected += 0.5 * mass * v @ v + 0.5 * inertia * w * w
    assert kinetic_energy(plant) == pytest.approx(expected, rel=1e-5)
    plant.close()


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
    # Springs lend and take back: the largest of each half second must not grow. Wheels in
    # contact never quite come to rest.
    largest = np.reshape(energies, (-1, 10)).max(axis=1)
    assert started > 5.0
    assert (np.diff(largest[1:]) <= (0.0 if option["drive"]["kind"] == "slip" else 1e-8)).all()
    assert largest[-1] < 1e-3


def test_momentum_of_a_coasting_base_changes_by_the_measured_wrench(option, coasting):
    option["drive"] |= coasting[option["drive"]["kind"]]
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
