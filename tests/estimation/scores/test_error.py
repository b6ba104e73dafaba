import numpy as np
import pytest

from cowalk.estimation.scores.error import bias, lag, rmse

TRUTH = np.sin(np.linspace(0.0, 12.0, 600)) + np.linspace(0.0, 1.0, 600)


def test_error_and_bias_of_a_known_offset():
    assert rmse(TRUTH + 0.3, TRUTH) == pytest.approx(0.3)
    assert bias(TRUTH - 0.3, TRUTH) == pytest.approx(-0.3)


def test_unknown_samples_are_left_out():
    estimate = TRUTH.copy()
    estimate[::2] = np.nan
    assert rmse(estimate, TRUTH) == 0.0
    assert np.isnan(rmse(np.full(3, np.nan), np.ones(3)))


@pytest.mark.parametrize("delay", [-12, 0, 7, 30])
def test_lag_finds_a_known_delay(delay):
    pulse = np.exp(-0.5 * ((np.arange(400) - 200) / 20.0) ** 2)
    assert lag(np.roll(pulse, delay), pulse, period=0.05) == pytest.approx(delay * 0.05)


def test_a_constant_has_no_lag():
    assert np.isnan(lag(np.ones(50), TRUTH[:50], period=0.05))
