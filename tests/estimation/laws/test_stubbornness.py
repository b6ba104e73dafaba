import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.estimation.laws.stubbornness import (
    interaction_value,
    stubbornness,
    stubbornness_norm,
    utility_loss,
)

LOWER, UPPER = np.array([0.0, -0.26]), np.array([1.2, 0.26])
FORCE_MAX = np.array([7.5, 7.5])


def estimate(force, wish_before, twist):
    return stubbornness(force, FORCE_MAX, wish_before, twist, LOWER, UPPER)


def test_the_papers_first_step_with_three_newton():
    x = estimate([0.0, 3.0], [0.8, 0.0], [0.8, 0.0])
    np.testing.assert_allclose(x, [0.0, 0.40])


def test_the_second_factor_by_hand():
    # D = 0.052 + 0.26 = 0.312 and |p_H - p_A| = 0.04, so 0.4 * 0.272/0.312.
    x = estimate([0.0, 3.0], [0.8, 0.052], [0.8, 0.012])
    assert x[1] == pytest.approx(0.4 * 0.272 / 0.312)


within_v, within_omega = st.floats(0.0, 1.2), st.floats(-0.26, 0.26)


@given(
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
    st.tuples(within_v, within_omega),
    st.tuples(within_v, within_omega),
)
def test_stubbornness_stays_within_zero_and_one(force, wish, twist):
    x = estimate(force, wish, twist)
    assert ((x >= 0.0) & (x <= 1.0 + 1e-12)).all()


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=2), st.floats(0.0, 1.0))
def test_interaction_value_stays_within_its_stated_range(x, loss):
    value = float(interaction_value(stubbornness_norm(x), loss))
    assert -2.0 <= value <= 2.0 + 1e-12


shares = st.floats(0.0, 1.0)


@given(shares)
def test_the_norm_of_one_dimension_alone_is_exactly_the_papers(x):
    # A square below the smallest float is 0, and nobody's stubbornness.
    for values in ([x], [x, 0.0], [0.0, x]):
        assert float(stubbornness_norm(values)) == (x if x > 1e-150 else pytest.approx(x))


@given(st.lists(st.tuples(shares, shares, shares), min_size=1, max_size=4))
def test_the_norm_is_bounded_and_rises_with_every_dimension(drawn):
    x, y, more = np.array(drawn).T
    norm = stubbornness_norm(np.stack((x, y), axis=-1))
    assert norm.shape == x.shape
    assert ((norm >= np.maximum(x, y) - 1e-12) & (norm <= 1.0)).all()
    larger = np.maximum(x, more)
    assert (stubbornness_norm(np.stack((larger, y), axis=-1)) >= norm).all()
    assert (stubbornness_norm(np.stack((y, larger), axis=-1)) >= norm).all()


def test_two_half_stubborn_dimensions_count_more_than_one():
    assert float(stubbornness_norm([0.3, 0.4])) == pytest.approx(0.5)
    assert float(stubbornness_norm([0.8, 0.8])) == 1.0


def test_interaction_value_reaches_its_stated_maximum():
    assert float(interaction_value(stubbornness_norm([1.0, 1.0]), 1.0)) == pytest.approx(2.0)
    assert float(interaction_value(stubbornness_norm([0.0]), 0.0)) == -2.0


def test_utility_loss_is_a_clipped_line():
    np.testing.assert_allclose(
        utility_loss([-3.0, -2.0, 0.0, 2.0, 5.0], -2.0, 2.0), [0.0, 0.0, 0.5, 1.0, 1.0]
    )


@given(st.floats(0.0, 1.0))
def test_the_loop_settles_at_the_stubbornness(x):
    loss = 0.0
    for _ in range(60):
        loss = float(utility_loss(interaction_value(x, loss), -2.0, 2.0))
    assert loss == pytest.approx(x, abs=1e-9)
