"""The force sensor: exact when off, and each fault as large as it says."""

import numpy as np
import pytest

from cowalk.sim.errors import InputError
from cowalk.sim.sensor import ForceSensor, SensorParameters

FORCE = np.random.default_rng(1).normal(0.0, 5.0, (20000, 2))


def sensor(**faults):
    return ForceSensor(SensorParameters(**faults), np.random.default_rng(3))


def test_without_faults_the_very_input():
    assert np.array_equal(sensor().measure(FORCE), FORCE)


def test_bias_and_noise():
    error = sensor(noise=(0.3, 0.1), bias=(1.0, -2.0)).measure(FORCE) - FORCE
    assert error.mean(axis=0) == pytest.approx((1.0, -2.0), abs=0.01)
    assert error.std(axis=0) == pytest.approx((0.3, 0.1), rel=0.02)
    assert abs(np.corrcoef(error[:-1, 0], error[1:, 0])[0, 1]) < 0.02, "white"
    assert abs(np.corrcoef(error.T)[0, 1]) < 0.02, "axes are independent"


def test_resolution_and_range():
    reading = sensor(resolution=0.25, range=6.0).measure(FORCE)
    assert np.abs(reading).max() == 6.0
    assert np.array_equal(reading, np.round(reading * 4.0) / 4.0)
    inside = np.abs(FORCE) < 6.0
    assert np.abs(reading - FORCE)[inside].max() <= 0.125


def test_seeded():
    one, two = sensor(noise=(1.0, 1.0)), sensor(noise=(1.0, 1.0))
    first = one.measure(FORCE)
    # Noise belongs to the sample, not to how the samples are cut into blocks.
    assert np.array_equal(first, np.concatenate([two.measure(FORCE[:7]), two.measure(FORCE[7:])]))
    assert not np.array_equal(first, one.measure(FORCE))
    one.reset(np.random.default_rng(3))
    assert np.array_equal(first, one.measure(FORCE))


def test_input_is_left_alone():
    force = FORCE.copy()
    sensor(noise=(1.0, 1.0), bias=(1.0, 1.0), resolution=0.1, range=2.0).measure(force)
    assert np.array_equal(force, FORCE)


@pytest.mark.parametrize("faults", [{"noise": (-0.1, 0.0)}, {"resolution": -1.0}, {"range": 0.0}])
def test_nonsense_is_refused(faults):
    with pytest.raises(InputError, match=next(iter(faults))):
        SensorParameters(**faults)
