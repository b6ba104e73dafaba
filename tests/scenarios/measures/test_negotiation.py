import numpy as np
import pytest

from cowalk.scenarios import (
    conflict_share,
    executed_concession,
    false_concession,
    ripple,
    stride_ripple,
    time_apart,
)

ROWS = 200
TIME = (np.arange(ROWS) + 1) * 0.05
ONES = np.ones(ROWS)


def conceded(executed, own=0.0, human=0.4):
    return executed_concession(own * ONES, human * ONES, executed * ONES, 0.5)


def test_concession_is_0_at_ones_own_wish_and_1_at_the_humans_whichever_side_it_lies():
    assert conceded(0.0).value == pytest.approx(0.0)
    assert conceded(0.1).value == pytest.approx(0.25)
    assert conceded(0.4).value == pytest.approx(1.0)
    assert conceded(-0.1, human=-0.4).value == pytest.approx(0.25)


def test_turning_away_or_wobbling_is_no_concession():
    assert conceded(-0.2).value == pytest.approx(-0.5)
    assert conceded(0.2 * np.sin(np.arange(ROWS))).value == pytest.approx(0.0, abs=0.01)


def test_concession_rests_on_rows_in_which_the_wishes_differ():
    human = np.where(np.arange(ROWS) < 50, 0.4, 0.01)
    score = executed_concession(0.0 * ONES, human, 0.2 * ONES, 0.5)
    assert score.value == pytest.approx(0.5)
    assert score.share == pytest.approx(0.25)
    assert np.isnan(conceded(0.2, human=0.01).value)
    assert np.isnan(conceded(0.2, human=np.nan).value)


def test_time_apart_starts_beyond_a_tenth_of_the_bound():
    wish = np.array([0.049 * ONES, 0.051 * ONES])
    assert time_apart(wish, 0.0 * wish, np.array([0.5, 0.5]), 0.05).value.tolist() == [0.0, 10.0]
    half = np.where(np.arange(ROWS) < 100, np.nan, 0.3)
    score = time_apart(half, 0.0 * half, 0.5, 0.05)
    assert (score.value, score.share) == (5.0, 0.5)


def test_a_concession_is_false_where_the_human_lets_go():
    gone = false_concession(0.0 * ONES, 0.1 * ONES, 0.0 * ONES, 0.5, TIME)
    assert gone.value == 1.0
    assert gone.share == pytest.approx((TIME >= 4.0).mean())
    assert false_concession(0.0 * ONES, 0.04 * ONES, 0.0 * ONES, 0.5, TIME).value == 0.0
    assert np.isnan(false_concession(0.0 * ONES, 0.1 * ONES, 0.5 * ONES, 0.5, TIME).value)


def test_ripple_is_what_the_body_adds_whatever_the_person_means():
    meant = 5.0 * np.sin(0.3 * TIME)
    added = 3.0 * np.sin(2.0 * np.pi * 0.8 * TIME)
    assert ripple(meant + added + 1.0, meant) == pytest.approx(3.0 / np.sqrt(2.0), rel=0.02)


def test_a_stride_leaves_steps_and_takes_out_a_push():
    steps = np.sin(2.0 * np.pi * TIME / 0.7)
    assert stride_ripple(steps + 5.0, 0.05) == pytest.approx(np.sqrt(0.5), rel=0.05)
    assert stride_ripple(0.1 * TIME, 0.05) == pytest.approx(0.0, abs=0.01)
    assert np.isnan(stride_ripple(np.ones(20), 0.05))


def test_conflict_takes_both_and_more_than_ripple_of_each():
    push = 5.0 * ONES
    assert conflict_share(push, -3.0 * ONES, 1.0, 1.0).value == 1.0
    assert conflict_share(push, 3.0 * ONES, 1.0, 1.0).value == 0.0
    assert conflict_share(push, -0.5 * ONES, 1.0, 1.0).value == 0.0
    assert conflict_share(0.5 * ONES, -3.0 * ONES, 1.0, 1.0).value == 0.0
