import numpy as np
import pytest

from cowalk.estimation import bias, rmse, squared_error

TRUTH = np.sin(np.linspace(0.0, 12.0, 600)) + np.linspace(0.0, 1.0, 600)


def test_error_and_bias_of_a_known_offset():
    assert rmse(TRUTH + 0.3, TRUTH).value == pytest.approx(0.3)
    assert squared_error(TRUTH + 0.3, TRUTH).value == pytest.approx(0.09)
    assert bias(TRUTH - 0.3, TRUTH).value == pytest.approx(-0.3)
    assert rmse(TRUTH + 0.3, TRUTH).share == 1.0


def test_unknown_samples_are_left_out_and_the_share_says_so():
    estimate = TRUTH.copy()
    estimate[::2] = np.nan
    assert rmse(estimate, TRUTH) == (0.0, 0.5)
    value, share = rmse(np.full(3, np.nan), np.ones(3))
    assert np.isnan(value)
    assert share == 0.0


def test_only_rows_asked_for_count():
    rows = TRUTH > 0.5
    estimate = np.where(rows, TRUTH + 0.1, TRUTH + 9.0)
    assert rmse(estimate, TRUTH, rows).value == pytest.approx(0.1)
    assert rmse(estimate, TRUTH, rows).share == pytest.approx(rows.mean())
    assert np.isnan(bias(estimate, TRUTH, np.zeros(600, dtype=bool)).value)


def test_leading_axes_are_scored_apart():
    truth = np.stack((TRUTH, 2.0 * TRUTH))
    rows = np.stack((TRUTH > 0.0, TRUTH > 0.5))
    both = rmse(0.5 * truth, truth, rows)
    for i in range(2):
        one = rmse(0.5 * truth[i], truth[i], rows[i])
        assert (both.value[i], both.share[i]) == (one.value, one.share)


def test_who_speaks_only_where_it_is_easy_is_shown_by_the_share():
    truth = np.where(np.arange(100) < 90, 0.8, 0.5)
    silent = np.where(truth == 0.5, 0.5, np.nan)
    assert rmse(silent, truth) == (0.0, 0.1)
