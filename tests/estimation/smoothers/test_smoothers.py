"""Every registered smoother is held to the same rules; then each to its own."""

import numpy as np
import pytest

from cowalk.estimation.registry import SMOOTHERS
from cowalk.estimation.smoothers.kalman import KalmanSmoother
from cowalk.estimation.smoothers.moving_average import MovingAverage
from cowalk.sim.basics.errors import InputError

ALL = SMOOTHERS.names()


def smoothed(smoother, values):
    return np.array([smoother.update(value) for value in values])


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("shape", [(), (2,), (3, 2)])
def test_a_constant_passes_unchanged_in_any_shape(name, shape):
    smoother = SMOOTHERS.get(name)()
    level = np.full(shape, 0.7)
    smoother.reset(level)
    for _ in range(10):
        out = smoother.update(level)
        assert out.shape == shape
        np.testing.assert_allclose(out, level, atol=1e-9)


@pytest.mark.parametrize("name", ALL)
def test_a_step_is_reached_in_time_and_not_at_once(name):
    smoother = SMOOTHERS.get(name)()
    smoother.reset(0.0)
    answer = smoothed(smoother, [1.0] * 60)
    assert answer[0] < 0.9
    assert answer[-1] == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("name", ALL)
def test_noise_comes_out_smaller(name):
    smoother = SMOOTHERS.get(name)()
    smoother.reset(0.0)
    noise = np.random.default_rng(0).normal(size=400)
    assert smoothed(smoother, noise).std() < 0.8 * noise.std()


@pytest.mark.parametrize("name", ALL)
def test_reset_forgets_and_elements_are_independent(name):
    smoother = SMOOTHERS.get(name)()
    values = np.random.default_rng(1).normal(size=(20, 2))
    smoother.reset(np.zeros(2))
    first = smoothed(smoother, values)
    smoother.reset(np.zeros(2))
    np.testing.assert_array_equal(smoothed(smoother, values), first)
    smoother.reset(0.0)
    np.testing.assert_allclose(smoothed(smoother, values[:, 1]), first[:, 1], atol=1e-12)


def test_moving_average_is_the_mean_of_the_last_window():
    smoother = MovingAverage(window=5)
    smoother.reset(-2.0)
    values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    expected = [(-8 + 1) / 5, (-6 + 3) / 5, (-4 + 6) / 5, (-2 + 10) / 5, 3.0, 4.0]
    np.testing.assert_allclose(smoothed(smoother, values), expected)


def test_kalman_gain_settles_where_the_riccati_equation_says():
    from scipy.linalg import solve_discrete_are

    q, r = 0.05, 0.3
    smoother = KalmanSmoother(process_noise=q, measurement_noise=r)
    smoother.reset(0.0)
    smoothed(smoother, [0.0] * 300)
    transition, measurement = np.array([[1.0, 1.0], [0.0, 1.0]]), np.array([[1.0, 0.0]])
    process = q**2 * np.array([[0.25, 0.5], [0.5, 1.0]])
    prior = solve_discrete_are(transition.T, measurement.T, process, r**2 * np.eye(1))
    gain = prior[0, 0] / (prior[0, 0] + r**2)
    assert smoother.update(1.0) == pytest.approx(gain, rel=1e-6)


@pytest.mark.parametrize(
    "build", [lambda: MovingAverage(window=0), lambda: KalmanSmoother(process_noise=0.0)]
)
def test_impossible_parameters_are_refused(build):
    with pytest.raises(InputError, match="= 0"):
        build()
