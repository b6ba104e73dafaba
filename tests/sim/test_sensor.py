"""The force sensor: exact when off, and each fault as large as it says."""

import math
from copy import deepcopy

import numpy as np
import pytest
from scipy import signal

from cowalk.sim.errors import InputError
from cowalk.sim.sensor import ForceSensor, SensorParameters
from cowalk.sim.sensor_filter import LowPass
from cowalk.sim.sensor_parameters import PRESETS, sensor_preset

RATE = 240
FORCE = np.random.default_rng(1).normal(0.0, 5.0, (20000, 2))
REST = np.zeros((20000, 2))


def sensor(**faults):
    made = ForceSensor(SensorParameters(**faults), RATE)
    made.reset(np.random.default_rng(3))
    return made


def blocks(made, force, length=12):
    """Measure as an environment does, block by block."""
    parts = [made.measure(force[i : i + length]) for i in range(0, len(force), length)]
    return tuple(np.concatenate(part) for part in zip(*parts, strict=True))


def test_without_faults_the_very_input():
    reading = sensor().measure(FORCE)
    assert reading.force is FORCE
    assert reading.valid.all()
    assert not reading.saturated.any()


def test_noise_is_white_and_as_dense_as_it_says():
    noise = sensor(noise_density=(0.02, 0.05)).measure(REST).force
    frequency, density = signal.welch(noise, fs=RATE, nperseg=500, axis=0)
    assert np.sqrt(density[1:-1].mean(axis=0)) == pytest.approx((0.02, 0.05), rel=0.03)
    low, high = (frequency > 1) & (frequency < 20), (frequency > 100) & (frequency < 119)
    ratio = density[low].mean(axis=0) / density[high].mean(axis=0)
    assert ratio == pytest.approx((1.0, 1.0), abs=0.1)
    assert abs(np.corrcoef(noise.T)[0, 1]) < 0.02, "axes are independent"


def test_low_pass_leaves_its_noise_bandwidth():
    # Second-order Butterworth: f_c (pi/4) / sin(pi/4), for f_c well below half the sample rate.
    noise = blocks(sensor(noise_density=0.1, low_pass=10.0), np.zeros((100_000, 2)))[0]
    expected = 0.1 * math.sqrt(10.0 * (math.pi / 4) / math.sin(math.pi / 4))
    assert noise.std(axis=0) == pytest.approx((expected, expected), rel=0.03)


def test_low_pass_above_the_samples_folds_its_noise_down():
    noise = sensor(noise_density=0.1, low_pass=500.0).measure(REST).force
    expected = 0.1 * math.sqrt(500.0 * (math.pi / 4) / math.sin(math.pi / 4))
    assert noise.std(axis=0) == pytest.approx((expected, expected), rel=0.03)
    passed = sensor(low_pass=500.0).measure(FORCE).force
    np.testing.assert_array_equal(passed, FORCE)


def test_low_pass_is_3_db_down_at_its_frequency_and_exact_at_rest():
    time = np.arange(4800) / RATE
    wave = np.sin(2 * math.pi * 20.0 * time)[:, None] * np.ones(2)
    passed = blocks(sensor(low_pass=20.0), wave)[0]
    assert passed[2400:].std() == pytest.approx(wave.std() / math.sqrt(2.0), rel=1e-3)
    still = blocks(sensor(low_pass=20.0), np.full((480, 2), 7.0))[0]
    assert still[-1] == pytest.approx((7.0, 7.0), abs=1e-9)


@pytest.mark.parametrize("length", [1, 7, 12, 64, 65, 1000])
def test_blocks_of_any_length_are_filtered_as_scipy_does(length):
    one = LowPass(30.0, RATE, 2)
    parts = [one(FORCE[i : i + length]) for i in range(0, 2000, length)]
    expected = signal.sosfilt(signal.butter(2, 30.0, fs=RATE, output="sos"), FORCE[:2000], axis=0)
    np.testing.assert_allclose(np.concatenate(parts)[:2000], expected, atol=1e-12)


def test_bias_and_drift_are_a_line():
    zero = blocks(sensor(bias=(1.0, -2.0), drift=(36.0, 7.2)), np.zeros((RATE * 60, 2)))[0]
    time = np.arange(len(zero)) / 3600.0 / RATE
    slope, start = np.polyfit(time, zero, 1)
    assert slope == pytest.approx((36.0, 7.2), rel=1e-6)
    # The offset has drifted for as long as the sensor was on before the start: 0.5 s.
    assert start == pytest.approx((1.0 + 36.0 * 0.5 / 3600, -2.0 + 7.2 * 0.5 / 3600), abs=2e-4)


def test_tare_takes_the_bias_off_and_leaves_what_averaging_leaves():
    plain = sensor(bias=(4.0, -3.0), tare=True).measure(REST[:12]).force
    assert np.abs(plain).max() < 1e-12
    left = []
    noisy = ForceSensor(SensorParameters(bias=5.0, noise_density=0.1, tare=True), RATE)
    for seed in range(400):
        noisy.reset(np.random.default_rng(seed))
        left.append(noisy.measure(np.zeros((4800, 2))).force.mean(axis=0))
    # Mean of white noise over 0.5 s, and over the 20 s it is seen with here.
    expected = 0.1 * math.sqrt(1.0 / (2.0 * 0.5) + 1.0 / (2.0 * 20.0))
    assert np.std(left) == pytest.approx(expected, rel=0.08)
    assert abs(np.mean(left)) < 0.015


def test_cross_talk_mixes_channels():
    push = np.array([[10.0, 0.0], [0.0, 20.0]])
    np.testing.assert_allclose(
        sensor(cross_talk=0.02).measure(push).force, [[10.0, 0.2], [0.4, 20.0]], atol=1e-12
    )
    matrix = ((0.01, 0.03), (-0.02, 0.0))
    np.testing.assert_allclose(
        sensor(cross_talk=matrix).measure(push).force, [[10.1, -0.2], [0.6, 20.0]], atol=1e-12
    )


def test_saturation_is_flagged_and_resolution_is_a_step():
    reading = sensor(resolution=0.25, range=6.0).measure(FORCE)
    assert np.abs(reading.force).max() == 6.0
    np.testing.assert_array_equal(reading.force, np.round(reading.force * 4.0) / 4.0)
    beyond = np.abs(FORCE) > 6.0
    np.testing.assert_array_equal(reading.saturated, beyond.any(axis=1))
    assert np.abs(reading.force - FORCE)[~beyond].max() <= 0.125
    assert reading.valid.all()


def test_bias_eats_into_the_range():
    reading = sensor(bias=5.0, range=6.0, tare=True).measure(np.array([[3.0, -3.0]]))
    np.testing.assert_allclose(reading.force, [[1.0, -3.0]], atol=1e-12)
    assert reading.saturated.all()


@pytest.mark.parametrize(("latency", "samples"), [(0.0125, 3), (0.05, 12), (0.2, 48)])
def test_latency_shifts_by_whole_samples(latency, samples):
    force = blocks(sensor(latency=latency), FORCE[:2400])[0]
    np.testing.assert_array_equal(force[samples:], FORCE[: 2400 - samples])
    assert not force[:samples].any()


def test_saturation_is_flagged_when_it_arrives():
    push = np.zeros((240, 2))
    push[100] = 50.0
    force, _, saturated = blocks(sensor(latency=0.1, range=20.0), push)
    assert np.flatnonzero(saturated).tolist() == [124]
    assert force[124].tolist() == [20.0, 20.0]


@pytest.mark.parametrize("rate", [100.0, 80.0, 120.0, 33.3])
def test_conversions_are_held(rate):
    force = blocks(sensor(rate=rate), FORCE[:2400])[0]
    fresh = np.flatnonzero(np.diff(force[:, 0])) + 1
    np.testing.assert_array_equal(force[fresh], FORCE[fresh])
    assert len(fresh) == pytest.approx(rate * 10.0, abs=2)
    assert np.diff(fresh).max() <= math.ceil(RATE / rate)


def test_a_rate_above_the_samples_changes_nothing():
    np.testing.assert_array_equal(sensor(rate=1000.0).measure(FORCE).force, FORCE)


@pytest.mark.parametrize("faults", [{}, {"latency": 0.02}, {"rate": 120.0}])
def test_lost_samples_are_flagged_and_repeat_the_one_before(faults):
    force, valid, _ = blocks(sensor(drop_rate=0.05, **faults), FORCE)
    whole = blocks(sensor(**faults), FORCE)[0]
    assert np.mean(~valid) == pytest.approx(0.05, abs=0.006)
    np.testing.assert_array_equal(force[valid], whole[valid])
    again = np.flatnonzero(~valid)[1:]
    np.testing.assert_array_equal(force[again], force[again - 1])


def test_seeded_whatever_the_blocks():
    faults = {"noise_density": 0.1, "bias": 1.0, "drift": 3.0, "drop_rate": 0.05, "rate": 100.0}
    faults |= {"latency": 0.02, "range": 9.0, "resolution": 0.01, "tare": True}
    one, two = sensor(**faults), sensor(**faults)
    first = blocks(one, FORCE[:2400])
    for mine, theirs in zip(first, blocks(two, FORCE[:2400], length=30), strict=True):
        np.testing.assert_array_equal(mine, theirs)
    assert not np.array_equal(first[0], blocks(one, FORCE[:2400])[0])
    one.reset(np.random.default_rng(3))
    for mine, theirs in zip(first, blocks(one, FORCE[:2400]), strict=True):
        np.testing.assert_array_equal(mine, theirs)


def test_a_copy_goes_on_as_the_original():
    one = sensor(noise_density=0.1, low_pass=30.0, latency=0.02, drop_rate=0.1, rate=100.0)
    blocks(one, FORCE[:240])
    two = deepcopy(one)
    for mine, theirs in zip(blocks(one, FORCE[:240]), blocks(two, FORCE[:240]), strict=True):
        np.testing.assert_array_equal(mine, theirs)


@pytest.mark.parametrize("channels", [1, 3, 6])
def test_any_number_of_channels(channels):
    made = ForceSensor(sensor_preset("low-cost"), RATE, channels)
    assert made.measure(np.ones((12, channels))).force.shape == (12, channels)


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_measures_a_push_and_leaves_the_input_alone(name):
    push = np.tile([4.0, -3.0], (480, 1))
    made = ForceSensor(sensor_preset(name), RATE)
    made.reset(np.random.default_rng(0))
    force, valid, saturated = blocks(made, push)
    assert np.array_equal(push, np.tile([4.0, -3.0], (480, 1)))
    assert force[240:].mean(axis=0) == pytest.approx((4.0, -3.0), abs=0.3)
    assert not saturated.any()
    assert valid.mean() > 0.95


def test_presets_are_ordered_by_what_they_cost():
    laboratory, industrial, low_cost = (sensor_preset(name) for name in PRESETS)
    for name in ("drift", "cross_talk", "drop_rate", "latency", "bias"):
        values = [getattr(preset, name) for preset in (laboratory, industrial, low_cost)]
        assert values == sorted(values), name
    assert laboratory.rate > industrial.rate > low_cost.rate
    assert laboratory.range == 500.0
    assert (industrial.rate, industrial.resolution, industrial.range) == (100.0, 0.01, 300.0)
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
    "faults", [{"bias": (1.0, 2.0, 3.0)}, {"cross_talk": ((0.0,),)}, {"noise_density": (0.1,)}]
)
def test_the_wrong_number_of_channels_is_refused(faults):
    with pytest.raises(InputError, match=f"sensor.{next(iter(faults))}"):
        ForceSensor(SensorParameters(**faults), RATE)
