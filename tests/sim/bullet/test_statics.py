"""Signs and sizes of the measured force against closed forms."""

import math

import numpy as np
import pytest

from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import connect, disconnect, engine, force_on_parent
from cowalk.sim.plant.discs import HUMAN_PLACE
from cowalk.sim.robot.drive import DriveParameters
from cowalk.sim.world.world import World

KINDS = (engine.JOINT_FIXED, engine.JOINT_POINT2POINT)


@pytest.fixture
def client():
    client = connect()
    engine.setTimeStep(1.0 / 240.0, client)
    yield client
    disconnect(client)


@pytest.fixture(scope="module")
def plant():
    plant = BulletPlant(Rates())
    yield plant
    plant.close()


def lump(client, mass, place):
    body = engine.createMultiBody(mass, basePosition=place, physicsClientId=client)
    engine.changeDynamics(body, -1, linearDamping=0, angularDamping=0, physicsClientId=client)
    return body


def join(client, kind, parent, child, offset):
    half = [side / 2.0 for side in offset]
    return engine.createConstraint(
        parent, -1, child, -1, kind, (0, 0, 0), half, [-h for h in half], physicsClientId=client
    )


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("held_is_parent", "sign"), [(True, -1.0), (False, 1.0)])
def test_hanging_mass(client, kind, held_is_parent, sign):
    engine.setGravity(0, 0, -9.81, client)
    held, hanging = lump(client, 0.0, (0, 0, 0)), lump(client, 1.3, (0, 0, -0.5))
    pair = (held, hanging) if held_is_parent else (hanging, held)
    grip = join(client, kind, *pair, (0, 0, 0.5 * sign))
    for _ in range(240):
        engine.stepSimulation(client)
    force = force_on_parent(kind, engine.getConstraintState(grip, client))
    assert force == pytest.approx((0.0, 0.0, sign * 1.3 * 9.81), abs=1e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_push_splits_by_mass(client, kind):
    pushed, carried = lump(client, 3.0, (0, 0, 0)), lump(client, 1.0, (0.4, 0, 0))
    grip = join(client, kind, pushed, carried, (0.4, 0, 0))
    for _ in range(24):
        engine.applyExternalForce(
            pushed, -1, (8.0, 0, 0), (0, 0, 0), engine.LINK_FRAME, physicsClientId=client
        )
        engine.stepSimulation(client)
    # Both accelerate at 8 N / 4 kg; the carried kilogram holds the pushed body back with 2 N.
    force = force_on_parent(kind, engine.getConstraintState(grip, client))
    assert force == pytest.approx((-2.0, 0.0, 0.0), abs=1e-3)
    for body in (pushed, carried):
        assert engine.getBaseVelocity(body, client)[0][0] == pytest.approx(0.2, abs=1e-4)


def stand(plant, yaw, push, seconds=4.0):
    plant.reset(World(Path(((0, 0), (1, 0))), start=(2.0, -1.0, yaw)), np.random.default_rng(0))
    states = [plant.step((0.0, 0.0), push) for _ in range(round(20 * seconds))]
    return states[-20:]


@pytest.mark.parametrize("yaw", [0.0, 90.0, 137.0, -60.0])
@pytest.mark.parametrize("push", [(0.0, 5.0), (4.0, 0.0), (-3.0, -2.0)])
def test_force_is_of_the_human_on_the_base_in_base_axes(plant, yaw, push):
    states = stand(plant, math.radians(yaw), push)
    force = np.concatenate([state.force_on_base for state in states])
    assert np.linalg.norm(force.mean(axis=0) - push) <= 0.01 * np.linalg.norm(push)


@pytest.mark.parametrize("yaw", [0.0, 137.0])
def test_base_gives_way_the_way_it_is_pushed(plant, yaw):
    """The physical proof of the sign: slip speed is force over drive gain, in both axes."""
    drive = DriveParameters()
    push = (4.0, 3.0)
    states = stand(plant, math.radians(yaw), push)
    (x0, y0, yaw0), (x1, y1, yaw1) = states[0].pose, states[-1].pose
    cos, sin = math.cos((yaw0 + yaw1) / 2), math.sin((yaw0 + yaw1) / 2)
    dx, dy = (x1 - x0) / 0.95, (y1 - y0) / 0.95
    slip = (cos * dx + sin * dy, cos * dy - sin * dx)
    assert slip == pytest.approx(
        (push[0] / drive.gain_forward, push[1] / drive.gain_sideways), rel=0.01
    )
    moment = 0.15 * push[1] + 0.30 * push[0]  # the handle is 0.15 m ahead, 0.30 m to the right
    assert states[-1].twist[1] == pytest.approx(moment / drive.gain_yaw, rel=0.01)


@pytest.mark.parametrize("yaw", [0.0, 137.0])
def test_reset_puts_both_at_rest_where_the_world_says(plant, yaw):
    stand(plant, 1.0, (5.0, 5.0))
    start = (2.0, -1.0, math.radians(yaw))
    state = plant.reset(World(Path(((0, 0), (1, 0))), start=start), np.random.default_rng(0))
    assert state.pose == start
    assert state.twist == (0.0, 0.0)
    cos, sin = math.cos(start[2]), math.sin(start[2])
    x, y, turned = HUMAN_PLACE
    assert state.human_pose == pytest.approx(
        (2.0 + cos * x - sin * y, -1.0 + sin * x + cos * y, start[2] + turned), abs=1e-12
    )
    assert state.force_on_base.shape == (12, 2)
    assert not state.force_on_base.any()
    # Nobody pushes and nothing pulls: the posture fits the handle.
    assert np.abs(plant.step((0.0, 0.0), (0.0, 0.0)).force_on_base).max() < 1e-3
