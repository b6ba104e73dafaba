import functools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.estimation import lag
from cowalk.scenarios import load, run
from cowalk.sim.basics.errors import InputError

PERIOD = 0.05
T = np.arange(600) * PERIOD


def late(signal, delay):
    """Return a signal that comes so many rows later, and holds its first (or last) value."""
    if delay < 0:
        return late(signal[::-1], -delay)[::-1]
    return np.concatenate((np.full(delay, signal[0]), signal[: signal.size - delay]))


SIGNALS = {
    "pulse": np.exp(-0.5 * ((T - 15.0) / 1.0) ** 2),
    "ramp": np.clip((T - 8.0) / 8.0, 0.0, 1.0),
    "ramp without end": np.maximum(T - 10.0, 0.0),
    "step up": np.where(T < 12.0, 0.2, 0.6),
    "step down": np.where(T < 12.0, 0.6, 0.2),
    "steps": np.select([T < 10.0, T < 18.0], [0.2, 0.6], 0.4),
    "plateau": np.where((T > 6.0) & (T < 20.0), 1.0, 0.0),
    "sine": np.sin(T / 3.0),
    "sine on a trend": np.sin(T / 3.0) + T / 2.0,
    "saturating": 1.0 - np.exp(-np.maximum(T - 9.0, 0.0) / 3.0),
}


@functools.cache
def puddle():
    """Return the true stubbornness of the scenario, which grows and does not come back."""
    return run(load("puddle")).trace["true_stubbornness_omega"]


@pytest.mark.parametrize("delay", [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, -1.0])
def test_the_true_stubbornness_of_puddle_delayed(delay):
    truth = puddle()
    assert lag(late(truth, round(delay / PERIOD)), truth, PERIOD) == pytest.approx(delay)


@pytest.mark.parametrize("delay", [0.0, 0.25, 2.0, 4.0, 6.0, -2.0])
@pytest.mark.parametrize("name", SIGNALS)
def test_a_known_delay_is_found(name, delay):
    truth = SIGNALS[name]
    assert lag(late(truth, round(delay / PERIOD)), truth, PERIOD) == pytest.approx(delay)


@pytest.mark.parametrize("delay", [0.0, 2.0, 4.0])
@pytest.mark.parametrize("name", ["ramp", "step up", "steps", "plateau", "sine", "saturating"])
def test_it_is_found_in_an_estimate_that_is_noisy_biased_and_too_small(name, delay):
    truth = SIGNALS[name]
    noise = 0.1 * np.std(truth) * np.random.default_rng(3).standard_normal(T.size)
    estimate = 0.5 * (late(truth, round(delay / PERIOD)) + noise) + 0.3
    assert lag(estimate, truth, PERIOD) == pytest.approx(delay, abs=0.25)


def test_a_low_pass_lags_by_its_time_constant():
    truth, time_constant = SIGNALS["sine"], 0.5
    estimate = truth.copy()
    for k in range(1, truth.size):
        estimate[k] = estimate[k - 1] + (truth[k] - estimate[k - 1]) * PERIOD / time_constant
    assert lag(estimate, truth, PERIOD) == pytest.approx(time_constant, abs=PERIOD)


@pytest.mark.parametrize(
    "estimate",
    [
        np.full(600, 0.4),
        np.full(600, 0.537283),
        0.3 + 0.1 * T,
        np.random.default_rng(0).standard_normal(600),
        -SIGNALS["steps"],
        np.full(600, np.nan),
    ],
    ids=["constant", "another", "line", "noise", "upside down", "silent"],
)
def test_what_does_not_follow_the_truth_has_no_lag(estimate):
    assert np.isnan(lag(estimate, SIGNALS["steps"], PERIOD))
    assert np.isnan(lag(SIGNALS["steps"], estimate, PERIOD))


def test_a_line_with_noise_has_no_lag_to_read_rather_than_none():
    rng = np.random.default_rng(1)
    estimate = late(T, 40) + 0.1 * rng.standard_normal(600)
    assert np.isnan(lag(estimate, T + 0.1 * rng.standard_normal(600), PERIOD))


def test_what_is_later_than_is_looked_for_is_not_said_to_be_as_late_as_that():
    truth = SIGNALS["saturating"]
    assert np.isnan(lag(late(truth, 100), truth, PERIOD, longest=3.0))


def test_of_equal_delays_the_shortest():
    truth = np.sin(2.0 * np.pi * T / 3.0)
    assert lag(late(truth, 20), truth, PERIOD) == pytest.approx(1.0)


def test_unknown_rows_do_not_shift_time():
    truth = SIGNALS["steps"]
    estimate = late(truth, 30)
    estimate[100:140] = np.nan
    estimate[::7] = np.nan
    assert lag(estimate, truth, PERIOD) == pytest.approx(1.5)


def test_signals_of_two_lengths_and_no_period_are_refused():
    with pytest.raises(InputError, match="one length"):
        lag(T, T[1:], PERIOD)
    with pytest.raises(InputError, match="above 0"):
        lag(T, T, 0.0)


@given(
    levels=st.lists(st.integers(-20, 20), min_size=4, max_size=4),
    places=st.lists(st.integers(100, 300), min_size=3, max_size=3, unique=True),
    rise=st.integers(1, 60),
    delay=st.integers(-60, 60),
    gain=st.floats(0.1, 10.0),
    offset=st.floats(-5.0, 5.0),
    trend=st.floats(-0.5, 0.5),
)
def test_whatever_its_levels_gain_offset_and_trend_a_delay_is_found(
    levels, places, rise, delay, gain, offset, trend
):
    at = np.arange(400)
    truth = np.full(400, float(levels[0]))
    for place, before, after in zip(sorted(places), levels, levels[1:], strict=False):
        truth += (after - before) * np.clip((at - place + rise) / rise, 0.0, 1.0)
    if np.ptp(truth) == 0.0:
        assert np.isnan(lag(truth, truth, PERIOD))
        return
    estimate = gain * late(truth, delay) + offset + trend * at
    found = lag(estimate, truth, PERIOD, longest=4.0)
    assert found == pytest.approx(delay * PERIOD)
    assert lag(truth, estimate, PERIOD, longest=4.0) == pytest.approx(-found)
