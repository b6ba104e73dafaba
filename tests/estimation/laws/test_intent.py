import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.estimation.front_ends.mean import mean_force
from cowalk.estimation.laws.intent import human_wish, wish_change

UPPER = np.array([1.2, 0.26])


def change(fx, fy, threshold=0.0):
    return wish_change([fx, fy], [10.0, 7.5], [threshold] * 2, [0.5, 0.5], UPPER)


def test_a_full_push_asks_for_the_sensitivity_share_of_the_upper_bound():
    np.testing.assert_allclose(change(10.0, 7.5), [0.6, 0.13])
    np.testing.assert_allclose(change(30.0, 3.0), [0.6, 0.4 * 0.13])


@given(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0))
def test_pushing_the_other_way_asks_for_the_opposite(fx, fy):
    np.testing.assert_allclose(change(-fx, -fy), -change(fx, fy))


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_the_threshold_holds_for_either_direction(sign):
    assert not change(sign * 0.9, sign * 0.9, threshold=1.0).any()
    assert (sign * change(sign * 1.0, sign * 1.0, threshold=1.0) > 0.0).all()


def test_the_wish_stays_within_the_bounds_and_broadcasts():
    twists = np.array([[0.8, 0.2], [0.8, -0.2], [0.1, 0.0]])
    wishes = human_wish(twists, change(-10.0, 7.5), [0.0, -0.26], UPPER)
    np.testing.assert_allclose(wishes, [[0.2, 0.26], [0.2, -0.07], [0.0, 0.13]])


def test_lost_samples_are_left_out_of_the_mean():
    force = np.array([[1.0, 2.0], [3.0, 4.0], [100.0, 100.0]])
    np.testing.assert_array_equal(mean_force(force), force.mean(axis=0))
    np.testing.assert_allclose(mean_force(force, np.array([1.0, 1.0, 0.0])), [2.0, 3.0])
    np.testing.assert_allclose(mean_force(force, np.zeros(3)), force.mean(axis=0))
    lanes = np.stack((force, 2.0 * force))
    valid = np.array([[1.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    np.testing.assert_allclose(mean_force(lanes, valid), [[2.0, 3.0], [200.0, 200.0]])
