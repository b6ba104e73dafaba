"""What must hold for every sensor on every way of building the plant: drive x grip x coupling."""

import functools
import itertools
import math

import numpy as np
import pytest

from cowalk.sim import parallel_env
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.grip import GRIPS
from cowalk.sim.robot.coupling import COUPLINGS
from cowalk.sim.robot.drive import DRIVES
from cowalk.sim.sensor.channels import channels, coupling
from cowalk.sim.sensor.parameters import SensorParameters
from cowalk.sim.sensor.presets import PRESETS, sensor_preset
from cowalk.sim.sensor.wrench import SensorMount, in_base_frame

BUILT = list(itertools.product(DRIVES, GRIPS, COUPLINGS))
SENSED = list(itertools.product(PRESETS, BUILT))
NAMES = ["-".join((preset, *built)) for preset, built in SENSED]
WRIST = {"turn_stiffness": (0.0, 0.0, 1.0), "turn_damping": (0.0, 0.0, 0.05)}
MOUNT = SensorMount((0.03, -0.02, -0.08), (0.1, -0.2, 0.7))
STEP = 1.0 / 240.0
PUSH = 24.0
"""Largest of the push that is summed, N along x and along y."""
BOUND = {"laboratory": 0.02, "industrial": 0.07, "low-cost": 0.08}
"""Share of the impulse that noise, tare and jitter of a preset may hide at most."""


LIGHTER = {"laboratory": 5.0, "low-cost": 4.0}
"""Loads, kg, that leave a preset room for a push on wheels, where 8 kg weigh 25 N m."""


def environment(built, sensor, control=20, mass=8.0, **drive):
    kind, grip, load = built
    return parallel_env(
        sensor=sensor,
        start="standing",
        rates=Rates(control),
        plant_parameters={
            "drive": {"kind": kind, **drive},
            "grip": {"kind": grip, **WRIST},
            "coupling": {"kind": load} | ({"mass": mass} if load == "stretcher" else {}),
            "gait": {"enabled": True},
            "mount": MOUNT,
        },
    )


def walk(env):
    """Return all that the bodies do, and all that is read, on a course that is set beforehand."""
    bodies, read = [], []
    env.reset(seed=1)
    pair = env.plant._pair
    for step in range(40):
        push = np.array([2.0 * math.sin(0.3 * step), 3.0]) * (step < 25)
        env.step({"human": push, "automation": np.array([0.8, 0.3 * math.sin(0.1 * step)])})
        state = env.plant_state
        bodies.append([*state.wrench_on_base.flat, *pair.base_state, *pair.human_state])
        bodies[-1] += pair.load_state
        read.append(env.sensor_reading.wrench)
    return np.array(bodies).tobytes(), np.array(read).tobytes()


@functools.cache
def bodies_with_an_exact_sensor(built):
    env = environment(built, SensorParameters())
    bodies, _ = walk(env)
    env.close()
    return bodies


@pytest.mark.parametrize(("preset", "built"), SENSED, ids=NAMES)
def test_no_sensor_moves_a_body_and_one_seed_is_one_reading(preset, built):
    """So whatever holds for the bodies, their energy too, holds with every sensor."""
    env = environment(built, sensor_preset(preset))
    bodies, read = walk(env)
    again = walk(env)
    env.close()
    assert bodies == bodies_with_an_exact_sensor(built)
    assert again == (bodies, read)


def age(sensor):
    """Return how old a reading is on average, and by how much more or less at most, s."""
    held = 0.0 if sensor.rate * STEP >= 1.0 else 1.0 / sensor.rate - STEP
    transport = round(sensor.latency / STEP) * STEP
    return transport + held / 2.0 + math.sqrt(2.0) / (math.tau * sensor.low_pass), held / 2.0 + STEP


def stated_error(sensor, felt, flagged, rates):
    """Return how far the summed reading may be off for what the sensor states, (6,), N s, N m s.

    Cross-talk and mean age are left out: they are known, and taken off.

    Parameters
    ----------
    sensor : SensorParameters
    felt : ndarray, shape (n, 6)
        The true wrench about the handle, base axes.
    flagged : int
        Lost samples.
    rates : ndarray, shape (n,)
        Of the turning base, rad/s.
    """
    time = len(felt) * STEP
    lag, apart = age(sensor)
    late = math.ceil((lag + apart) / STEP)
    under_way = apart * np.abs(felt[-late:]).max(axis=0)
    turned = apart * STEP * np.abs(rates) @ np.hypot(*felt[:, :2].T) * np.array([1, 1, 0, 0, 0, 0])
    lost = flagged * STEP * np.abs(felt[late:] - felt[:-late]).max(axis=0)
    # White noise, summed, and what averaging half a second has left of it in the tare; four
    # standard deviations.
    noise = 4.0 * channels(sensor, "noise_density") * math.hypot(math.sqrt(time / 2.0), time)
    mixed = np.linalg.inv(coupling(sensor)) @ MOUNT.to_base
    steady = time * channels(sensor, "resolution") / 2.0  # of the tare
    steady += time * (time + 0.5) * channels(sensor, "drift") / 3600.0
    return under_way + turned + lost + np.sqrt(noise**2 @ mixed**2) + steady @ np.abs(mixed)


@pytest.mark.parametrize(("preset", "built"), SENSED, ids=NAMES)
def test_what_is_read_is_the_change_of_momentum(preset, built, coasting):
    """A base that nothing but the hand moves: every reading at 240 Hz, summed in world axes."""
    sensor = sensor_preset(preset)
    mass = LIGHTER.get(preset, 8.0) if built[0] == "wheels" else 8.0
    env = environment(built, sensor, 240, mass, **coasting[built[0]])
    env.reset(seed=4)
    x, y, _ = env.plant._pair.handle
    unmixed = np.linalg.inv(coupling(sensor))
    felt, moved, read, flagged = [], [np.zeros(4)], [], 0
    # Agents speak of turns: at a tail their sideways force is the other way round.
    aside = np.array([1.0, -1.0 if env.plant.steers_from_behind else 1.0])
    for step in range(360):
        push = np.array([PUSH, PUSH]) * math.sin(math.pi * step / 180.0) ** 2 * (step < 180)
        env.step({"human": push * aside, "automation": np.zeros(2)})
        reading, state = env.sensor_reading, env.plant_state
        assert not reading.saturated.any()
        flagged += int((~reading.valid).sum())
        felt.append(state.wrench_on_base[0])
        moved.append(np.array([state.pose[2], *env.plant._pair.base_state[3:]]))
        read.append(in_base_frame(reading.wrench[0] @ unmixed, MOUNT))
    env.close()
    # Where the base was, and how it moved, when what is read was felt.
    now = STEP * np.arange(361.0)
    then = np.maximum(now - age(sensor)[0], 0.0)
    yaw, *speeds = (np.interp(then, now, column) for column in np.transpose(moved))
    fx, fy, _, _, _, mz = np.transpose(read)
    cos, sin = np.cos(yaw[1:]), np.sin(yaw[1:])
    moment = mz + x * fy - y * fx
    momentum = STEP * np.sum([cos * fx - sin * fy, sin * fx + cos * fy, moment], axis=1)
    expected = np.array([40.0, 40.0, 1.57]) * np.transpose(speeds)[-1]
    error = stated_error(sensor, np.array(felt), flagged, np.transpose(moved)[3][1:])
    turning = error[5] + math.hypot(x, y) * math.hypot(*error[:2])
    assert np.hypot(*error[:2]) < BOUND[preset] * np.hypot(*expected[:2]), "else it says little"
    assert (np.abs(momentum - expected) < [*error[:2], turning]).all()
