"""Cadence and sway of the trunk, as measured and as a function of time."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim.basics.errors import InputError
from cowalk.sim.body.gait import FORE_AFT, LATERAL, Gait, GaitParameters, step_frequency, sway_at

STEP = 1.0 / 240.0


def settled(speed, seconds=8.0, **parameters):
    gait = Gait(GaitParameters(enabled=True, **parameters), STEP)
    gait.reset(np.random.default_rng(0))
    for _ in range(round(5.0 / STEP)):
        gait.update(speed)
    return np.array([gait.update(speed) for _ in range(round(seconds / STEP))])


def test_cadence_is_the_measured_one_at_the_preferred_speed():
    assert step_frequency(1.3) == pytest.approx(1.82)


@given(st.floats(0.3, 2.0))
def test_step_length_grows_with_speed_to_the_0_42(speed):
    lengths = [v / step_frequency(v) for v in (speed, 1.3)]
    assert math.log(lengths[0] / lengths[1]) == pytest.approx(0.42 * math.log(speed / 1.3))


def test_cadence_agrees_with_grieve_and_gear():
    """64.8 (v / stature)^0.57 strides a minute for men (1966), two steps a stride."""
    for speed in (0.6, 0.8, 1.0, 1.3, 1.6):
        expected = 2.0 * 64.8 * (speed / 1.75) ** 0.57 / 60.0
        assert step_frequency(speed) == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("index", [0, 1, 2])
def test_sway_has_the_measured_size(index):
    percentile = (5.0, 50.0, 95.0)[index]
    assert sway_at(percentile) == pytest.approx((FORE_AFT[index], LATERAL[index]))
    sway = settled(1.0, percentile=percentile)
    assert np.ptp(sway[:, :2], axis=0) == pytest.approx((FORE_AFT[index], LATERAL[index]), rel=1e-3)


@given(st.floats(5.0, 95.0), st.floats(5.0, 95.0))
def test_sway_grows_with_the_percentile(one, other):
    low, high = sorted((one, other))
    assert all(a <= b for a, b in zip(sway_at(low), sway_at(high), strict=True))


def test_velocity_and_acceleration_are_derivatives():
    sway = settled(1.0)
    np.testing.assert_allclose(
        sway[1:-1, 2:4], (sway[2:, :2] - sway[:-2, :2]) / (2 * STEP), atol=2e-3
    )
    # The acceleration is of half a step ahead.
    np.testing.assert_allclose(sway[:-1, 4:6], np.diff(sway[:, 2:4], axis=0) / STEP, atol=5e-3)


@pytest.mark.parametrize("speed", [0.4, 0.8, 1.2])
def test_fore_aft_once_a_step_lateral_once_a_stride(speed):
    sway = settled(speed, seconds=20.0)
    for axis, expected in ((0, step_frequency(speed)), (1, step_frequency(speed) / 2.0)):
        crossings = np.sum((sway[:-1, axis] < 0.0) & (sway[1:, axis] >= 0.0))
        assert crossings == pytest.approx(20.0 * expected, abs=1.0)


def test_standing_still_is_still():
    assert np.abs(settled(0.0)).max() == 0.0


def test_the_phase_is_the_seeds():
    def start(seed):
        gait = Gait(GaitParameters(enabled=True), STEP)
        gait.reset(np.random.default_rng(seed))
        return gait.phase

    assert start(1) == start(1)
    assert start(1) != start(2)


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"percentile": 99.0}, "percentile = 99.0"),
        ({"fore_aft": -0.1}, "fore_aft = -0.1 m"),
        ({"step_frequency": 0.0}, "step_frequency = 0.0 Hz"),
    ],
)
def test_no_such_gait(given, named):
    with pytest.raises(InputError, match=named):
        GaitParameters(**given)
