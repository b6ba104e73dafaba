import numpy as np
import pytest

from cowalk.scenarios import band_rms, effort, log_dimensionless_jerk, squared_effort


def time(period, duration=30.0):
    return np.arange(round(duration / period)) * period


def test_efforts_of_what_is_known():
    assert effort([[1.0, -3.0], [0.0, 2.0]], 0.5).tolist() == [2.0, 1.0]
    assert squared_effort([1.0, -3.0], 0.5) == 5.0


@pytest.mark.parametrize("period", [0.05, 0.025, 0.0125])
def test_shaking_is_the_rms_of_a_sine_in_the_band_at_any_rate(period):
    def shaking(frequency):
        return band_rms(2.0 * np.sin(2.0 * np.pi * frequency * time(period)), period)

    assert shaking(0.6) == pytest.approx(np.sqrt(2.0), rel=0.01)
    assert shaking(1.8) < 0.01
    assert shaking(0.1) < 0.05


def test_neither_a_level_nor_a_ramp_nor_the_ends_shake():
    t = time(0.05)
    assert band_rms(5.0 + 0.3 * t, 0.05) == pytest.approx(0.0, abs=1e-9)
    assert band_rms(np.sin(2.0 * np.pi * 0.02 * t), 0.05) < 0.01
    assert np.isnan(band_rms(np.ones(100), 0.05))


def test_jitter_is_jerkier_and_rest_is_neither():
    t = time(0.05)
    smooth = 0.2 * np.sin(0.3 * t)
    jerky = smooth + 0.05 * np.sin(2.0 * np.pi * t)
    both = log_dimensionless_jerk(np.stack((smooth, jerky)), 0.05, 0.05)
    assert both[0] - both[1] > 2.0
    assert np.isnan(log_dimensionless_jerk(0.8 + 1e-3 * np.sin(9.0 * t), 0.05, 0.12))


def test_jerk_has_no_dimension_and_no_rate():
    values = [
        float(log_dimensionless_jerk(size * np.sin(0.5 * time(period)), period, 0.01))
        for period, size in ((0.05, 0.2), (0.025, 0.2), (0.0125, 2.0))
    ]
    assert np.ptp(values) < 0.05


def test_jerk_of_a_minimum_jerk_movement():
    """v = 30 s^2 (1 - s)^2: the integral of its squared second derivative is 720, its peak 15/8."""
    s = np.linspace(0.0, 1.0, 4001)[:, None]
    speed = (30.0 * s * s * (1.0 - s) ** 2)[:, 0]
    padded = np.concatenate((np.zeros(1), speed, np.zeros(1)))
    found = log_dimensionless_jerk(padded, 0.05, 0.1)
    assert found == pytest.approx(-np.log(720.0 * 64.0 / 225.0), abs=0.03)
