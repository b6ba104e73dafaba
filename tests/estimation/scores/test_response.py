import numpy as np
import pytest

from cowalk.estimation import overshoot, rise_time
from cowalk.sim.basics.errors import InputError

PERIOD = 0.05
T = np.arange(200) * PERIOD
UP, DOWN = (0.2, 0.6), (0.6, 0.2)


def answer(before, after, time_constant, dead_time=0.0):
    return after + (before - after) * np.exp(-np.maximum(T - dead_time, 0.0) / time_constant)


@pytest.mark.parametrize("step", [UP, DOWN])
@pytest.mark.parametrize("dead_time", [0.0, 1.5])
def test_a_first_order_answer_rises_in_its_time_constant(step, dead_time):
    found = rise_time(answer(*step, 1.0, dead_time), *step, PERIOD)
    assert found == pytest.approx(1.0 + dead_time, abs=PERIOD)
    assert overshoot(answer(*step, 1.0, dead_time), *step) == 0.0


def test_the_mean_over_people_is_judged():
    quick, slow = answer(*UP, 0.2), answer(*UP, 3.0)
    mean = rise_time(0.5 * (quick + slow), *UP, PERIOD)
    assert rise_time(np.stack((quick, slow)), *UP, PERIOD) == mean
    assert rise_time(quick, *UP, PERIOD) < mean < rise_time(slow, *UP, PERIOD)


def test_a_spike_is_no_rise():
    spiky = answer(*UP, 1.0, 2.0)
    spiky[10:19] = 0.6  # 0.45 s
    assert rise_time(spiky, *UP, PERIOD) == pytest.approx(3.0, abs=PERIOD)


@pytest.mark.parametrize("value", [0.2, 0.4, 0.6, 1.0])
def test_a_constant_is_infinitely_slow(value):
    assert rise_time(np.full(200, value), *UP, PERIOD) == np.inf
    assert rise_time(np.full(200, value), *DOWN, PERIOD) == np.inf


def test_an_estimate_that_hardly_moves_is_not_quick():
    shy = 0.4 + 0.1 * (answer(*UP, 0.1) - 0.4)
    assert rise_time(shy, *UP, PERIOD) == np.inf


def test_one_row_over_the_end_of_the_record_is_not_held():
    late = np.where(T[-5] < T, 0.6, 0.2)
    assert rise_time(late, *UP, PERIOD) == np.inf
    assert rise_time(late[:3], *UP, PERIOD) == np.inf


@pytest.mark.parametrize("step", [UP, DOWN])
def test_overshoot_is_a_share_of_the_step(step):
    before, after = step
    high = np.where((T > 1.0) & (T < 2.0), after + 0.25 * (after - before), after)
    assert overshoot(high, *step) == pytest.approx(0.25)


def test_the_truth_must_step():
    with pytest.raises(InputError, match="step"):
        rise_time(T, 0.5, 0.5, PERIOD)
    with pytest.raises(InputError, match="step"):
        overshoot(T, 0.5, 0.5)
