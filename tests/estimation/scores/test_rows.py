import numpy as np
import pytest

from cowalk.estimation import demand, identifiable, insistence, row_before

UPPER = np.array([1.2, 0.5])


def judged(rows=4, **changed):
    """Return which rows are identifiable of a person of moderate demands, from 5 s on."""
    given = {
        "time": 5.0 + np.arange(rows),
        "stubbornness": np.full((rows, 2), 0.5),
        "wish": np.full((rows, 2), 0.3),
        "twist_before": np.full((rows, 2), 0.1),
        "force_intent": np.full((rows, 2), 2.0),
        "lower": -UPPER,
        "upper": UPPER,
        "gain": (2.0, 2.0),
        "force_limit": (7.5, 7.5),
    }
    return identifiable(**(given | changed))


def test_a_moderate_disagreement_can_be_read():
    assert judged().all()


def test_the_first_three_seconds_cannot():
    found = judged(time=np.array([0.05, 2.95, 3.0, 3.05]))
    assert found.tolist() == [[False] * 2] * 2 + [[True] * 2] * 2


@pytest.mark.parametrize(("apart", "readable"), [(0.09, False), (0.11, True)])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_agreement_cannot(apart, readable, side):
    wish = 0.1 + side * apart * np.broadcast_to(UPPER, (4, 2))
    assert (judged(wish=wish) == readable).all()


def test_each_dimension_is_judged_alone():
    wish = np.array([[0.1, 0.3]] * 4)
    assert judged(wish=wish).tolist() == [[False, True]] * 4


@pytest.mark.parametrize(("gain", "readable"), [(4.9, True), (5.1, False)])
def test_a_saturated_law_cannot(gain, readable):
    # kappa s |p_H - p|/p_ub = gain * 0.5 * 0.2/0.5 in omega.
    assert (judged(gain=(1.0, gain))[:, 1] == readable).all()


def test_a_force_at_a_limit_cannot():
    force = np.array([[2.0, -7.5], [-7.5, 7.4], [8.0, 9.0], [7.4, -7.4]])
    wanted = [[True, False], [False, True], [False, False], [True, True]]
    assert judged(force_intent=force).tolist() == wanted


def test_a_wish_beyond_the_bounds_is_as_far_off_as_the_bound():
    twist = np.broadcast_to(UPPER * 0.95, (4, 2))
    assert not judged(wish=np.full((4, 2), 5.0), twist_before=twist, gain=(0.01, 0.01)).any()


@pytest.mark.parametrize("name", ["wish", "stubbornness", "twist_before", "force_intent"])
def test_what_nobody_knows_cannot(name):
    assert not judged(**{name: np.full((4, 2), np.nan)}).any()


def test_batches_of_runs_are_judged_at_once():
    times = np.stack((np.arange(4.0), 5.0 + np.arange(4.0)))
    found = judged(time=times)
    assert found.shape == (2, 4, 2)
    assert found[:, :, 0].tolist() == [[False] * 3 + [True], [True] * 4]


def test_a_human_answers_to_the_row_before():
    twist = np.arange(6.0).reshape(3, 2)
    before = row_before(twist)
    assert np.isnan(before[0]).all()
    assert before[1:].tolist() == twist[:-1].tolist()


def test_demand_is_the_share_of_the_bound_that_is_insisted_on():
    assert demand((0.5, 1.0), (1.2, -0.25), (0.0, 0.25), UPPER) == pytest.approx((0.5, -1.0))
    assert np.isnan(demand(np.nan, 1.0, 0.0, UPPER)).all()


def test_insistence_is_known_without_a_wish():
    assert insistence((-3.0, 7.5), (6.0, 7.5)) == pytest.approx((0.5, 1.0))
