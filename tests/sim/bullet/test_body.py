"""The human in the engine against closed forms: pendulum, stiffness, limits, and either hand."""

import math

import numpy as np
import pytest

from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.anthropometry import BodyParameters
from cowalk.sim.body.arm import ELBOW_RANGE
from cowalk.sim.body.human_body import human_body
from cowalk.sim.bullet.chains import Chain
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import connect, disconnect, engine
from cowalk.sim.plant.discs import HUMAN_PLACE
from cowalk.sim.world.world import World

WORLD = World(Path(((0, 0), (20, 0))))
HANDLE = (0.15, -0.30, 1.04)
EVERY_STEP = Rates(control=240)
GRAVITY = 9.81


@pytest.fixture
def client():
    client = connect()
    engine.setTimeStep(1.0 / 240.0, client)
    yield client
    disconnect(client)


def body_in(client, **parameters):
    human = human_body(BodyParameters(**parameters), (HANDLE,))
    return human, Chain(client, human.urdf(), human.joints)


def lock(client, chain, *joints):
    for joint in joints:
        engine.setJointMotorControl2(
            chain.body,
            chain.joints[joint],
            engine.VELOCITY_CONTROL,
            targetVelocity=0.0,
            force=1e6,
            physicsClientId=client,
        )


@pytest.mark.parametrize("elbow", [-0.3, -1.2])
@pytest.mark.parametrize("height", [1.6, 1.75])
def test_the_passive_arm_is_a_pendulum(client, height, elbow):
    """Gravity is put level here: the arm swings about the vertical axis of the shoulder."""
    human, chain = body_in(client, height=height)
    (arm,) = human.arms
    lock(client, chain, 0, 1, 2, 4)
    engine.setGravity(GRAVITY, 0.0, 0.0, client)
    upper, fore = arm.upper, arm.fore
    beyond = np.array([math.cos(elbow), math.sin(elbow)])
    fore_centre = np.array([upper.length, 0.0]) + fore.centre * beyond
    inertia = (
        upper.inertia
        + upper.mass * upper.centre**2
        + fore.inertia
        + fore.mass * fore_centre @ fore_centre
    )
    moment = upper.mass * np.array([upper.centre, 0.0]) + fore.mass * fore_centre
    hanging = -math.atan2(moment[1], moment[0])
    expected = 2.0 * math.pi * math.sqrt(inertia / (GRAVITY * np.linalg.norm(moment)))
    chain.put((0.0, 0.0, 0.0, hanging + 0.02, elbow))
    swing = []
    for _ in range(240 * 8):
        engine.stepSimulation(client)
        swing.append(chain.read()[3] - hanging)
    swing = np.array(swing)
    up = np.flatnonzero((swing[:-1] < 0.0) & (swing[1:] >= 0.0))
    exact = up - swing[up] / (swing[up + 1] - swing[up])
    assert np.diff(exact).mean() / 240.0 == pytest.approx(expected, rel=0.01)
    assert np.abs(swing).max() == pytest.approx(0.02, rel=0.02), "nothing damps it, nothing drives"


@pytest.mark.parametrize("stiffness", [50.0, 100.0, 300.0])
@pytest.mark.parametrize("direction", [0.0, 1.0, 2.5])
def test_the_free_arm_gives_way_by_force_over_stiffness(stiffness, direction):
    plant = BulletPlant(
        EVERY_STEP,
        walker={"hand_stiffness": stiffness, "hand_damping": 20.0},
        grip={"release_force": 0.5, "on_loss": "stop"},
    )
    plant.reset(WORLD, np.random.default_rng(0))
    for _ in range(48):
        plant.step((0.0, 0.0), (5.0, 0.0))
    assert not plant.step((0.0, 0.0), (0.0, 0.0)).grip_held
    (arm,), (rest,) = plant._pair.body.arms, plant._pair.body.rest
    force = 1.0 * np.array([math.cos(direction), math.sin(direction)])

    def hand():
        x, y, yaw, shoulder, elbow = plant._pair.human_state[:5]
        along = np.array([math.cos(shoulder), math.sin(shoulder)])
        beyond = np.array([math.cos(shoulder + elbow), math.sin(shoulder + elbow)])
        place = arm.shoulder + arm.upper.length * along + arm.fore.length * beyond
        cos, sin = math.cos(yaw), math.sin(yaw)
        turn = np.array([[cos, -sin], [sin, cos]])
        return place, np.array([x, y]) + turn @ place, turn

    for _ in range(240 * 6):
        _, where, _ = hand()
        engine.applyExternalForce(
            plant._pair.human.body,
            plant._pair.human.links["forearm_left"],
            (*force, 0.0),
            (*where, HANDLE[2]),
            engine.WORLD_FRAME,
            plant._pair.client,
        )
        plant.step((0.0, 0.0), (0.0, 0.0))
    place, _, turn = hand()
    plant.close()
    assert place - rest == pytest.approx(turn.T @ force / stiffness, rel=0.01, abs=1e-5)


def test_joint_limits_hold(client):
    human, chain = body_in(client)
    lock(client, chain, 0, 1, 2)
    for torque, limits in ((0.5, (2.95, -0.02)), (-0.5, (-1.05, -2.80))):
        chain.put((0.0, 0.0, 0.0, *human.posture))
        for _ in range(960):
            engine.setJointMotorControlArray(
                chain.body,
                chain.joints[3:],
                engine.TORQUE_CONTROL,
                forces=(torque, torque),
                physicsClientId=client,
            )
            engine.stepSimulation(client)
        assert chain.read()[3:5] == pytest.approx(limits, abs=1e-3)


@pytest.mark.parametrize("rate", [0.5, 5.0, 20.0])
def test_a_joint_flung_against_its_limit_passes_it_by_a_step_and_comes_back(rate):
    plant = BulletPlant(Rates(), walker={"hand_stiffness": 0.0, "hand_damping": 0.0})
    chain = plant._pair.human
    plant._pair.hands._hold(False)
    chain.put((0.0, 0.0, 0.0, *plant._pair.body.posture), (0.0, 0.0, 0.0, 0.0, rate))
    beyond, fastest = [], 0.0
    for _ in range(480):
        chain.apply((0.0, 0.0, 0.0, 0.0, 0.5))  # and pressed against it
        engine.stepSimulation(chain.client)
        state = chain.read()
        beyond.append(state[4] - ELBOW_RANGE[1])
        fastest = max(fastest, state[9])
    plant.close()
    assert 0.0 < max(beyond) <= fastest / 240.0 + 0.01
    assert max(beyond[-100:]) <= 1e-3


@pytest.mark.parametrize("hand", ["left", "right", "both"])
@pytest.mark.parametrize("push", [(0.0, 5.0), (4.0, -2.0)])
def test_any_hand_passes_on_the_intended_force(hand, push):
    plant = BulletPlant(Rates(), body={"hand": hand})
    plant.reset(WORLD, np.random.default_rng(0))
    states = [plant.step((0.8, 0.0), push) for _ in range(160)]
    plant.close()
    force = np.concatenate([state.force_on_base for state in states[120:]])
    assert force.mean(axis=0) == pytest.approx(push, abs=0.1)


def test_people_stand_where_their_hand_is():
    places = {}
    for hand in ("left", "right", "both"):
        plant = BulletPlant(Rates(), body={"hand": hand})
        places[hand] = plant.reset(WORLD, np.random.default_rng(0)).human_pose
        plant.close()
    assert places["left"] == pytest.approx(HUMAN_PLACE)
    assert places["right"] == pytest.approx((HUMAN_PLACE[0], -HUMAN_PLACE[1], 0.0))
    assert places["both"][0] < -0.5
    assert places["both"][1] == 0.0


@pytest.mark.parametrize(("height", "mass"), [(1.55, 50.0), (1.75, 70.0), (1.9, 100.0)])
def test_the_engine_carries_the_whole_mass(client, height, mass):
    _, chain = body_in(client, height=height, mass=mass)
    assert chain.mass == pytest.approx(mass)
