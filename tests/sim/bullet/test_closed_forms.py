"""The plant as it ships, its grips and its sensor's frame, against closed forms within 1 %."""

import math

import numpy as np
import pytest

from cowalk.sim import parallel_env
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.grip import GRIPS
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import engine
from cowalk.sim.robot.drive import DRIVES
from cowalk.sim.sensor.channels import coupling
from cowalk.sim.sensor.presets import PRESETS, sensor_preset
from cowalk.sim.sensor.wrench import SensorMount, in_base_frame
from cowalk.sim.world.world import World

WORLD = World(Path(((0, 0), (20, 0))))
MASS, BASE_MASS = 70.0, 40.0
HANDLE = (0.15, -0.30)
AT_CENTRE = SensorMount(position=(-HANDLE[0], -HANDLE[1], -0.4))
"""A sensor at the base's own axis, 0.4 m below the handle: a push has a lever in all three axes."""


def near(vector, expected):
    """Whether a vector is within 1 % of another's length."""
    off = np.subtract(vector, expected)
    return np.linalg.norm(off) <= 0.01 * np.linalg.norm(expected)


def walk(plant, steps, twist=(0.0, 0.0), push=(0.0, 0.0)):
    """Return the mean and the deviation of the last second's wrench, and the last state."""
    states = [plant.step(twist, push) for _ in range(steps)]
    wrench = np.concatenate([state.wrench_on_base for state in states[-20:]])
    return wrench.mean(axis=0), wrench.std(axis=0), states[-1]


@pytest.fixture
def build():
    plants = []

    def plant(**options):
        plants.append(BulletPlant(Rates(), **options))
        plants[-1].reset(WORLD, np.random.default_rng(0))
        return plants[-1]

    yield plant
    for made in plants:
        made.close()


@pytest.mark.parametrize("grip", GRIPS)
@pytest.mark.parametrize("drive", DRIVES)
def test_a_human_who_hangs_on_the_handle_weighs_what_they_weigh(build, drive, grip):
    """Down is backwards here, legs and arms are limp: grip and base carry all of the human."""
    limp = {"stiffness": 0.0, "damping": 100.0, "yaw_stiffness": 0.0, "hand_stiffness": 0.0}
    plant = build(drive={"kind": drive}, grip={"kind": grip}, body={"hand": "both"}, walker=limp)
    down = -9.81 if drive == "wheels" else 0.0
    engine.setGravity(-0.5, 0.0, down, plant._pair.client)
    wrench, ripple, _ = walk(plant, 240)
    assert near(wrench[:2], (-0.5 * MASS, 0.0))
    assert ripple[:2].max() < 0.02


@pytest.mark.parametrize("grip", GRIPS)
@pytest.mark.parametrize(
    ("drive", "hand"), [("slip", "left"), ("slip", "both"), ("wheels", "both")]
)
def test_a_push_splits_by_mass(build, drive, hand, grip):
    """The motors give all they have, 11 N; the human is drawn along by the handle alone."""
    motors = {"max_force": 11.0, "max_speed": 3.0, "max_acceleration": 5.0}
    plant = build(
        drive={"kind": drive, **motors},
        grip={"kind": grip},
        body={"hand": hand},
        walker={"stiffness": 0.0, "damping": 0.0, "hand_damping": 150.0},
    )
    wrench, _, _ = walk(plant, 160, twist=(3.0, 0.0))
    # Wheels turn as they roll: two discs of 1.5 kg weigh half as much again.
    rolling = 2 * 1.5 / 2.0 if drive == "wheels" else 0.0
    assert near(wrench[:2], (-11.0 * MASS / (MASS + BASE_MASS + rolling), 0.0))


def held_back(grip, push):
    """Return what of a push the arm itself takes, over the way that a yielding grip gives."""
    return np.array(push) * (4000.0 / (4000.0 + 100.0) if grip == "compliant" else 1.0)


@pytest.mark.parametrize("grip", GRIPS)
@pytest.mark.parametrize("push", [(0.0, 5.0), (5.0, 0.0), (-3.0, -4.0)])
@pytest.mark.parametrize("twist", [(0.8, 0.0), (0.0, 0.0)])
def test_a_steady_push_reads_as_intended(build, twist, push, grip):
    plant = build(grip={"kind": grip}, mount=AT_CENTRE)
    wrench, ripple, state = walk(plant, 200, twist, push)
    expected = held_back(grip, push)
    assert near(wrench[:2], expected)
    assert ripple.max() < 1e-4
    # The hand is 0.4 m above the sensor, ahead of it and to its right: M = r x F.
    lever = np.array([*HANDLE, 0.4])
    read = state.wrench_on_sensor.mean(axis=0)
    assert near(read[:3], (*expected, 0.0))
    assert near(read[3:], np.cross(lever, (*expected, 0.0)))
    # And that is what turns the base against the ground.
    drive = plant._pair.base._drive
    turning = state.twist[1] * drive._gain_yaw
    assert turning == pytest.approx(read[5], rel=0.01)


@pytest.mark.parametrize("preset", PRESETS)
def test_a_known_force_at_a_known_lever_is_that_torque_behind_a_sensor(preset):
    """Each preset states its cross-talk; with that known and taken off, 1 % of the load is left."""
    sensor = sensor_preset(preset, drift=0.0, torque_drift=0.0)
    mount = SensorMount(AT_CENTRE.position, (0.2, -0.1, 0.8))
    env = parallel_env(sensor=sensor, plant_parameters={"mount": mount})
    env.reset(seed=3)
    read = []
    for _ in range(300):
        env.step({"human": np.array([12.0, -16.0]), "automation": np.zeros(2)})
        read.append(env.sensor_reading.wrench)
    env.close()
    unmixed = np.concatenate(read[100:]) @ np.linalg.inv(coupling(sensor))
    about_handle = in_base_frame(unmixed.mean(axis=0), mount)
    at_centre = SensorMount(AT_CENTRE.position)
    seen = about_handle @ at_centre.to_sensor
    assert near(seen[:3], (12.0, -16.0, 0.0))
    assert near(seen[3:], np.cross((*HANDLE, 0.4), (12.0, -16.0, 0.0)))


@pytest.mark.parametrize("grip", GRIPS)
def test_a_wrist_is_a_torsion_spring_in_the_only_axis_that_bodies_on_the_floor_turn_in(build, grip):
    wrist = {"kind": grip, "turn_stiffness": (50.0, 50.0, 2.0), "turn_damping": (5.0, 5.0, 0.0)}
    plant = build(grip=wrist, gait={"enabled": True}, walker={"hand_stiffness": 50.0})
    pair = plant._pair
    bent = sum(pair.body.posture)
    turned, read = [], []
    for _ in range(80):
        wrench = plant.step((0.8, 0.0), (0.0, 0.0)).wrench_on_base
        assert not wrench[:, 3:5].any(), "roll and pitch do nothing in the plane"
        read.append(wrench[-1, 5])
        _, _, yaw, shoulder, elbow = pair.human_state[:5]
        turned.append(yaw + shoulder + elbow - pair.base_state[2] - bent)
    turned, read = np.array(turned), np.array(read)
    # A torque belongs to the angle at the beginning of its physics steps, up to three ago.
    assert np.abs(read).max() > 0.05
    assert np.abs(read - 2.0 * turned).max() < 0.1 * np.abs(read).max()
    assert np.polyfit(turned, read, 1)[0] == pytest.approx(2.0, rel=0.01)


@pytest.mark.parametrize("grip", GRIPS)
def test_force_and_torque_of_a_passive_arm_hold_its_links_in_balance(build, grip):
    """Two links with weight, down being aside: their moments about shoulder and elbow vanish."""
    wrist = {"turn_stiffness": (0.0, 0.0, 5.0), "turn_damping": (0.0, 0.0, 1.0)}
    plant = build(grip={"kind": grip, **wrist}, walker={"hand_stiffness": 0.0, "hand_damping": 5.0})
    down = np.array([-0.6, 1.0])
    pair = plant._pair
    engine.setGravity(*down, 0.0, pair.client)
    _, ripple, state = walk(plant, 240)
    assert ripple.max() < 0.01, "settled, but for the base that is slowly turned"
    wrench = state.wrench_on_base[-1]
    (arm,), yaw = pair.body.arms, state.pose[2]
    cos, sin = math.cos(yaw), math.sin(yaw)
    on_hand = -np.array([cos * wrench[0] - sin * wrench[1], sin * wrench[0] + cos * wrench[1]])
    turns = np.cumsum(pair.human_state[2:5])
    links = np.stack((np.cos(turns), np.sin(turns)), axis=-1)[1:]
    to_upper, to_fore = arm.upper.centre * links[0], arm.fore.centre * links[1]
    elbow, hand = arm.upper.length * links[0], arm.fore.length * links[1]

    def moment(lever, force):
        return lever[0] * force[1] - lever[1] * force[0]

    of_forearm = moment(to_fore, arm.fore.mass * down)
    of_arm = moment(to_upper, arm.upper.mass * down) + moment(elbow + to_fore, arm.fore.mass * down)
    loads = [wrench[5] - of_arm, wrench[5] - of_forearm]
    levers = np.stack((elbow + hand, hand))
    expected = np.linalg.solve(np.stack((-levers[:, 1], levers[:, 0]), axis=-1), loads)
    assert near(on_hand, expected)
    without = np.linalg.solve(
        np.stack((-levers[:, 1], levers[:, 0]), axis=-1), [-of_arm, -of_forearm]
    )
    assert not near(on_hand, without), "the wrist's torque counts"
