"""The force sensor: exact when off, and each fault as large as it says."""

import math
from copy import deepcopy

import numpy as np
import pytest
from scipy import signal

from cowalk.sim.basics.errors import InputError
from cowalk.sim.sensor.channels import coupling
from cowalk.sim.sensor.filter import LowPass
from cowalk.sim.sensor.presets import PRESETS, sensor_preset
from cowalk.sim.sensor.sensor import ForceSensor, SensorParameters
from cowalk.sim.sensor.wrench import SensorMount, in_base_frame, in_sensor_frame

RATE = 240
LOAD = np.random.default_rng(1).normal(0.0, 5.0, (20000, 6))
REST = np.zeros((20000, 6))
FORCES, TORQUES = slice(0, 3), slice(3, 6)


def both(name, value):
    """A fault of the same size on forces (N) and on torques (N m)."""
    return {name: value, f"torque_{name}": value}


def sensor(**faults):
    made = ForceSensor(SensorParameters(**faults), RATE)
    made.reset(np.random.default_rng(3))
    return made


def blocks(made, load, length=12):
    """Measure as an environment does, block by block; wrench, valid and saturated."""
    parts = [made.measure(load[i : i + length])[1:] for i in range(0, len(load), length)]
    return tuple(np.concatenate(part) for part in zip(*parts, strict=True))


def test_without_faults_the_very_input():
    reading = sensor().measure(LOAD)
    assert reading.wrench is LOAD
    np.testing.assert_array_equal(reading.force, LOAD[:, :2])
    assert reading.valid.all()
    assert not reading.saturated.any()


def test_noise_is_white_and_as_dense_as_it_says():
    made = sensor(noise_density=(0.02, 0.05, 0.01), torque_noise_density=0.003)
    noise = made.measure(np.zeros((100_000, 6))).wrench
    frequency, density = signal.welch(noise, fs=RATE, nperseg=500, axis=0)
    expected = (0.02, 0.05, 0.01, 0.003, 0.003, 0.003)
    assert np.sqrt(density[1:-1].mean(axis=0)) == pytest.approx(expected, rel=0.03)
    low, high = (frequency > 1) & (frequency < 20), (frequency > 100) & (frequency < 119)
    ratio = density[low].mean(axis=0) / density[high].mean(axis=0)
    assert ratio == pytest.approx(np.ones(6), abs=0.1)
    assert np.abs(np.corrcoef(noise.T) - np.eye(6)).max() < 0.025, "channels are independent"


def test_low_pass_leaves_its_noise_bandwidth():
    # Second-order Butterworth: f_c (pi/4) / sin(pi/4), for f_c well below half the sample rate.
    made = sensor(**both("noise_density", 0.1), low_pass=10.0)
    noise = blocks(made, np.zeros((100_000, 6)))[0]
    expected = 0.1 * math.sqrt(10.0 * (math.pi / 4) / math.sin(math.pi / 4))
    assert noise.std(axis=0) == pytest.approx(np.full(6, expected), rel=0.03)


def test_low_pass_above_the_samples_folds_its_noise_down():
    noise = sensor(**both("noise_density", 0.1), low_pass=500.0).measure(REST).wrench
    expected = 0.1 * math.sqrt(500.0 * (math.pi / 4) / math.sin(math.pi / 4))
    assert noise.std(axis=0) == pytest.approx(np.full(6, expected), rel=0.03)
    passed = sensor(low_pass=500.0).measure(LOAD).wrench
    np.testing.assert_array_equal(passed, LOAD)


def test_low_pass_is_3_db_down_at_its_frequency_and_exact_at_rest():
    time = np.arange(4800) / RATE
    wave = np.sin(2 * math.pi * 20.0 * time)[:, None] * np.ones(6)
    passed = blocks(sensor(low_pass=20.0), wave)[0]
    assert passed[2400:].std() == pytest.approx(wave.std() / math.sqrt(2.0), rel=1e-3)
    still = blocks(sensor(low_pass=20.0), np.full((480, 6), 7.0))[0]
    assert still[-1] == pytest.approx(np.full(6, 7.0), abs=1e-9)


@pytest.mark.parametrize("length", [1, 7, 12, 64, 65, 1000])
def test_blocks_of_any_length_are_filtered_as_scipy_does(length):
    one = LowPass(30.0, RATE, 6)
    parts = [one(LOAD[i : i + length]) for i in range(0, 2000, length)]
    expected = signal.sosfilt(signal.butter(2, 30.0, fs=RATE, output="sos"), LOAD[:2000], axis=0)
    np.testing.assert_allclose(np.concatenate(parts)[:2000], expected, atol=1e-12)


def test_bias_and_drift_are_a_line():
    bias, drift = np.array([1.0, -2.0, 0.5, 0.1, 0.1, 0.1]), np.array([36.0, 7.2, 0, 1.8, -1.8, 0])
    made = sensor(
        bias=tuple(bias[FORCES]),
        drift=tuple(drift[FORCES]),
        torque_bias=0.1,
        torque_drift=tuple(drift[TORQUES]),
    )
    zero = blocks(made, np.zeros((RATE * 60, 6)))[0]
    time = np.arange(len(zero)) / 3600.0 / RATE
    slope, start = np.polyfit(time, zero, 1)
    assert slope == pytest.approx(drift, rel=1e-6, abs=1e-9)
    # The offset has drifted for as long as the sensor was on before the start: 0.5 s.
    assert start == pytest.approx(bias + drift * 0.5 / 3600.0, abs=2e-4)


def test_two_numbers_are_for_x_and_y():
    zero = sensor(bias=(1.0, -2.0), torque_bias=(0.1, 0.2)).measure(REST[:1]).wrench
    np.testing.assert_array_equal(zero, [[1.0, -2.0, 0.0, 0.1, 0.2, 0.0]])


def test_tare_takes_the_bias_off_and_leaves_what_averaging_leaves():
    plain = sensor(bias=(4.0, -3.0, 1.0), torque_bias=0.5, tare=True).measure(REST[:12]).wrench
    assert np.abs(plain).max() < 1e-12
    left = []
    noisy = ForceSensor(
        SensorParameters(**both("bias", 5.0), **both("noise_density", 0.1), tare=True), RATE
    )
    for seed in range(150):
        noisy.reset(np.random.default_rng(seed))
        left.append(noisy.measure(np.zeros((4800, 6))).wrench.mean(axis=0))
    # Mean of white noise over 0.5 s, and over the 20 s it is seen with here.
    expected = 0.1 * math.sqrt(1.0 / (2.0 * 0.5) + 1.0 / (2.0 * 20.0))
    assert np.std(left) == pytest.approx(expected, rel=0.08)
    assert abs(np.mean(left)) < 0.015


def test_cross_talk_mixes_channels():
    push = np.zeros((2, 6))
    push[0, 0], push[1, 1] = 10.0, 20.0
    mixed = sensor(cross_talk=0.02).measure(push).wrench
    np.testing.assert_allclose(mixed[:, FORCES], [[10.0, 0.2, 0.2], [0.4, 20.0, 0.4]], atol=1e-12)
    assert not mixed[:, TORQUES].any(), "without ranges nobody knows what share of a torque"
    matrix = ((0.01, 0.03), (-0.02, 0.0))
    mixed = sensor(cross_talk=matrix).measure(push).wrench
    np.testing.assert_allclose(mixed[:, :2], [[10.1, -0.2], [0.6, 20.0]], atol=1e-12)
    assert not mixed[:, 2:].any()


def test_cross_talk_is_a_share_of_full_scale_between_forces_and_torques():
    made = sensor(cross_talk=0.02, range=300.0, torque_range=30.0)
    load = np.diag([100.0, 0.0, 0.0, 0.0, 0.0, 6.0])
    mixed = made.measure(load).wrench
    # A third of full scale: 2 % of it is 2 N on a force, 0.2 N m on a torque.
    assert mixed[0] == pytest.approx([100.0, 2.0, 2.0, 0.2, 0.2, 0.2])
    # A fifth of full scale.
    assert mixed[5] == pytest.approx([1.2, 1.2, 1.2, 0.12, 0.12, 6.0])


def test_a_matrix_of_six_rows_says_what_reads_what():
    matrix = np.zeros((6, 6))
    matrix[0, 5], matrix[4, 1] = 0.3, -0.01  # force x reads torque z, torque y reads force y
    made = sensor(cross_talk=tuple(map(tuple, matrix)))
    mixed = made.measure(np.array([[0.0, 20.0, 0.0, 0.0, 0.0, 2.0]])).wrench
    assert mixed[0] == pytest.approx([0.6, 20.0, 0.0, 0.0, -0.2, 2.0])


def test_saturation_is_flagged_and_resolution_is_a_step():
    made = sensor(resolution=0.25, range=6.0, torque_resolution=0.5, torque_range=8.0)
    reading = made.measure(LOAD)
    assert np.abs(reading.wrench).max(axis=0).tolist() == [6.0] * 3 + [8.0] * 3
    for part, step in ((FORCES, 0.25), (TORQUES, 0.5)):
        read = reading.wrench[:, part]
        np.testing.assert_array_equal(read, np.round(read / step) * step)
    beyond = np.abs(LOAD) > np.repeat((6.0, 8.0), 3)
    np.testing.assert_array_equal(reading.saturated, beyond.any(axis=1))
    wrong = np.abs(reading.wrench - LOAD)
    assert wrong[:, FORCES][~beyond[:, FORCES]].max() <= 0.125
    assert 0.125 < wrong[:, TORQUES][~beyond[:, TORQUES]].max() <= 0.25
    assert reading.valid.all()


@pytest.mark.parametrize("channel", range(6))
def test_saturation_of_any_channel_is_flagged(channel):
    load = np.zeros((3, 6))
    load[1, channel] = 3.0
    limits = {"range": 2.0, "torque_range": 2.0}
    assert sensor(**limits).measure(load).saturated.tolist() == [False, True, False]
    limits["range" if channel < 3 else "torque_range"] = 4.0
    assert not sensor(**limits).measure(load).saturated.any()


@pytest.mark.parametrize("coarse", ["resolution", "torque_resolution"])
def test_only_what_has_a_step_is_rounded(coarse):
    read = sensor(**{coarse: 1.0}).measure(LOAD).wrench
    stepped, fine = (FORCES, TORQUES) if coarse == "resolution" else (TORQUES, FORCES)
    np.testing.assert_array_equal(read[:, stepped], np.round(LOAD[:, stepped]))
    np.testing.assert_array_equal(read[:, fine], LOAD[:, fine])


def test_bias_eats_into_the_range():
    load = np.array([[3.0, -3.0, 0.0, 0.3, -0.3, 0.0]])
    made = sensor(bias=5.0, range=6.0, torque_bias=0.5, torque_range=0.6, tare=True)
    reading = made.measure(load)
    np.testing.assert_allclose(reading.wrench, [[1.0, -3.0, 0, 0.1, -0.3, 0]], atol=1e-12)
    assert reading.saturated.all()


MOUNT = SensorMount((0.05, -0.02, -0.1), (0.3, -0.2, 1.2))


STANDING = np.array([0.5, -1.0, -78.0, 1.4, 9.0, 0.2])


@pytest.mark.parametrize("mount", [SensorMount(), MOUNT], ids=["at handle", "mounted"])
@pytest.mark.parametrize("name", PRESETS)
def test_the_tare_takes_off_what_is_clamped_on(name, mount):
    """As an operator zeroes a sensor with its tool mounted: only what is added later is read."""
    push = np.tile([4.0, -2.0, 0.0, 0.0, 0.0, 0.5], (480, 1))
    bare, laden = (ForceSensor(sensor_preset(name), RATE) for _ in range(2))
    bare.reset(np.random.default_rng(3))
    laden.reset(np.random.default_rng(3), STANDING, mount)
    expected, read = bare.measure(push, mount), laden.measure(STANDING + push, mount)
    # The same noise, so apart by no more than roundings of reading and tare.
    step = np.repeat([sensor_preset(name).resolution, sensor_preset(name).torque_resolution], 3)
    assert (np.abs(read.wrench - expected.wrench) <= 2.0 * step + 1e-9).all()
    assert not read.saturated.any()


def test_without_a_tare_what_is_clamped_on_is_read_from_the_first_sample_on():
    made = ForceSensor(SensorParameters(low_pass=10.0, latency=0.05, cross_talk=0.01), RATE)
    made.reset(np.random.default_rng(0), STANDING)
    expected = STANDING @ coupling(SensorParameters(cross_talk=0.01))
    read = made.measure(np.tile(STANDING, (24, 1))).wrench
    np.testing.assert_allclose(read, np.tile(expected, (24, 1)), rtol=1e-9)


def test_unloaded_is_the_same_to_the_bit_whether_said_or_not():
    silent, said = (ForceSensor(sensor_preset("industrial"), RATE) for _ in range(2))
    silent.reset(np.random.default_rng(3))
    said.reset(np.random.default_rng(3), np.zeros(6), MOUNT)
    pairs = zip(silent.measure(LOAD[:480], MOUNT), said.measure(LOAD[:480], MOUNT), strict=True)
    assert all(one.tobytes() == other.tobytes() for one, other in pairs)


@pytest.mark.parametrize(
    ("load", "named"),
    [
        ([0, 0, -78, 0, 25, 0], r"sensor.torque_range = 20 N m: .* reads 25.* N m about y, .*80%"),
        ([0, 0, -700, 0, 0, 0], r"sensor.range = 500 N: .* reads -698 N along z, .*72%"),
    ],
)
def test_what_is_clamped_on_must_leave_something_to_read_with(load, named):
    with pytest.raises(InputError, match=named):
        ForceSensor(sensor_preset("laboratory")).reset(
            np.random.default_rng(0), np.array(load, dtype=float)
        )


def test_the_sensor_works_in_its_own_axes():
    seen = in_sensor_frame(LOAD, MOUNT)
    exact = sensor().measure(LOAD, MOUNT)
    np.testing.assert_array_equal(exact.wrench, seen)
    np.testing.assert_array_equal(exact.force, LOAD[:, :2])
    # What a fault does to the sensor's axes reaches the force through the mount.
    biased = sensor(bias=(1.0, 0.0, 0.0)).measure(LOAD, MOUNT)
    np.testing.assert_allclose(biased.wrench - seen, np.tile([1.0, 0, 0, 0, 0, 0], (20000, 1)))
    shift = in_base_frame(np.array([1.0, 0, 0, 0, 0, 0]), MOUNT)[:2]
    np.testing.assert_allclose(biased.force - LOAD[:, :2], np.tile(shift, (20000, 1)), atol=1e-12)
    step = sensor(resolution=0.5).measure(LOAD, MOUNT)
    np.testing.assert_allclose(
        step.force,
        in_base_frame(np.where(np.arange(6) < 3, np.round(seen * 2) / 2, seen), MOUNT)[:, :2],
    )


@pytest.mark.parametrize(("latency", "samples"), [(0.0125, 3), (0.05, 12), (0.2, 48)])
def test_latency_shifts_by_whole_samples(latency, samples):
    load = blocks(sensor(latency=latency), LOAD[:2400])[0]
    np.testing.assert_array_equal(load[samples:], LOAD[: 2400 - samples])
    assert not load[:samples].any()


def test_saturation_is_flagged_when_it_arrives():
    push = np.zeros((240, 6))
    push[100] = 50.0
    load, _, saturated = blocks(sensor(latency=0.1, range=20.0), push)
    assert np.flatnonzero(saturated).tolist() == [124]
    assert load[124].tolist() == [20.0] * 3 + [50.0] * 3


@pytest.mark.parametrize("rate", [100.0, 80.0, 120.0, 33.3])
def test_conversions_are_held(rate):
    load = blocks(sensor(rate=rate), LOAD[:2400])[0]
    fresh = np.flatnonzero(np.diff(load[:, 0])) + 1
    np.testing.assert_array_equal(load[fresh], LOAD[fresh])
    assert len(fresh) == pytest.approx(rate * 10.0, abs=2)
    assert np.diff(fresh).max() <= math.ceil(RATE / rate)


def test_a_rate_above_the_samples_changes_nothing():
    np.testing.assert_array_equal(sensor(rate=1000.0).measure(LOAD).wrench, LOAD)


@pytest.mark.parametrize("faults", [{}, {"latency": 0.02}, {"rate": 120.0}])
def test_lost_samples_are_flagged_and_repeat_the_one_before(faults):
    load, valid, _ = blocks(sensor(drop_rate=0.05, **faults), LOAD)
    whole = blocks(sensor(**faults), LOAD)[0]
    assert np.mean(~valid) == pytest.approx(0.05, abs=0.006)
    np.testing.assert_array_equal(load[valid], whole[valid])
    again = np.flatnonzero(~valid)[1:]
    np.testing.assert_array_equal(load[again], load[again - 1])


def test_seeded_whatever_the_blocks():
    faults = {"noise_density": 0.1, "bias": 1.0, "drift": 3.0, "drop_rate": 0.05, "rate": 100.0}
    faults |= {"latency": 0.02, "range": 9.0, "resolution": 0.01, "tare": True}
    faults |= {"torque_noise_density": 0.1, "torque_range": 9.0, "torque_resolution": 0.01}
    one, two = sensor(**faults), sensor(**faults)
    first = blocks(one, LOAD[:2400])
    for mine, theirs in zip(first, blocks(two, LOAD[:2400], length=30), strict=True):
        np.testing.assert_array_equal(mine, theirs)
    assert not np.array_equal(first[0], blocks(one, LOAD[:2400])[0])
    one.reset(np.random.default_rng(3))
    for mine, theirs in zip(first, blocks(one, LOAD[:2400]), strict=True):
        np.testing.assert_array_equal(mine, theirs)


def test_a_copy_goes_on_as_the_original():
    one = sensor(noise_density=0.1, low_pass=30.0, latency=0.02, drop_rate=0.1, rate=100.0)
    blocks(one, LOAD[:240])
    two = deepcopy(one)
    for mine, theirs in zip(blocks(one, LOAD[:240]), blocks(two, LOAD[:240]), strict=True):
        np.testing.assert_array_equal(mine, theirs)


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_measures_a_push_and_leaves_the_input_alone(name):
    steady = (4.0, -3.0, 0.0, 0.3, 0.4, 0.5)
    push = np.tile(steady, (480, 1))
    made = ForceSensor(sensor_preset(name), RATE)
    made.reset(np.random.default_rng(0))
    load, valid, saturated = blocks(made, push)
    assert np.array_equal(push, np.tile(steady, (480, 1)))
    # Cross-talk is a share of full scale, a force's being 10 to 25 times a torque's.
    talk = coupling(sensor_preset(name))
    assert load[240:].mean(axis=0) == pytest.approx(steady @ talk, abs=0.02)
    assert np.abs(steady @ talk - steady).max() < 1.5
    assert not saturated.any()
    assert valid.mean() > 0.95


def test_presets_are_ordered_by_what_they_cost():
    laboratory, industrial, low_cost = (sensor_preset(name) for name in PRESETS)
    torques = ("torque_drift", "torque_bias")
    for name in ("drift", "cross_talk", "drop_rate", "latency", "bias", *torques):
        values = [getattr(preset, name) for preset in (laboratory, industrial, low_cost)]
        assert values == sorted(values), name
    assert laboratory.rate > industrial.rate > low_cost.rate
    assert (laboratory.range, laboratory.torque_range) == (500.0, 20.0)
    assert (industrial.rate, industrial.resolution, industrial.range) == (100.0, 0.01, 300.0)
    assert (industrial.torque_resolution, industrial.torque_range) == (0.001, 30.0)
    assert low_cost.rate == 80.0


def test_presets_are_changed_by_name():
    changed = sensor_preset("industrial", noise_density=0.5)
    assert changed.noise_density == 0.5
    assert changed.rate == sensor_preset("industrial").rate
    with pytest.raises(InputError, match="'laboratry'; did you mean 'laboratory'"):
        sensor_preset("laboratry")


@pytest.mark.parametrize(
    "faults",
    [
        {"noise_density": (-0.1, 0.0)},
        {"torque_noise_density": -0.1},
        {"torque_resolution": math.nan},
        {"torque_range": 0.0},
        {"torque_bias": math.inf},
        {"resolution": -1.0},
        {"range": 0.0},
        {"range": math.nan},
        {"drop_rate": 1.0},
        {"latency": math.inf},
        {"low_pass": -3.0},
        {"bias": math.nan},
        {"drift": ()},
    ],
)
def test_nonsense_is_refused(faults):
    with pytest.raises(InputError, match=next(iter(faults))):
        SensorParameters(**faults)


@pytest.mark.parametrize(
    "faults",
    [
        {"bias": (1.0, 2.0, 3.0, 4.0)},
        {"cross_talk": ((0.0,),)},
        {"cross_talk": ((0.0, 0.1),)},
        {"noise_density": (0.1,)},
        {"torque_drift": (0.1,)},
    ],
)
def test_the_wrong_number_of_channels_is_refused(faults):
    with pytest.raises(InputError, match=f"^{next(iter(faults))} .*give one number, or"):
        ForceSensor(SensorParameters(**faults), RATE)
