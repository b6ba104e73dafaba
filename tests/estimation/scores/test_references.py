import numpy as np
import pytest

from cowalk.estimation import (
    AffineCalibration,
    Prior,
    better_prior_crps,
    crps_skill,
    gap_closed,
    rmse,
)
from cowalk.estimation.scores.people import People
from cowalk.sim.basics.errors import InputError

RNG = np.random.default_rng(5)
TRUTH = np.clip(RNG.normal(0.3, 0.2, 2000), 0.0, 1.0)
ALIKE = np.full(2000, 1.0 / 2000)


def test_no_constant_beats_the_prior_where_it_was_fitted():
    prior = Prior.fit(TRUTH, ALIKE)
    best = rmse(np.full(2000, prior.mean), TRUTH).value
    constants = [rmse(np.full(2000, x), TRUTH).value for x in np.linspace(0.0, 1.0, 101)]
    assert best <= min(constants)
    assert prior.weights.sum() == pytest.approx(1.0)
    assert (prior.weights >= 0.0).all()


def test_a_prior_scores_rows_unlike_those_it_was_fitted_on_worse():
    prior = Prior.fit(TRUTH, ALIKE)
    assert prior.crps(TRUTH).mean() < 0.12 < prior.crps(1.0 - TRUTH).mean()


def test_weights_and_rows_say_what_counts():
    truth = np.array([0.0, 0.0, 1.0, np.nan])
    weights = np.array([0.1, 0.1, 0.6, 0.2])
    assert Prior.fit(truth, weights).mean == pytest.approx(0.75)
    assert Prior.fit(truth, weights, [True, True, False, True]).mean == 0.0
    with pytest.raises(InputError, match="nothing to be fitted on"):
        Prior.fit(truth, weights, [False, False, False, True])


def test_the_ends_are_values_of_their_own():
    prior = Prior.fit([0.0, 1.0], [0.5, 0.5])
    assert prior.weights[[0, -1]].tolist() == [0.5, 0.5]


def test_the_better_prior_depends_on_the_rows():
    low, high = Prior.fit(TRUTH, ALIKE), Prior.fit(1.0 - TRUTH, ALIKE)
    rows = TRUTH > 0.6
    both = better_prior_crps(TRUTH, (high, low))
    assert both.tolist() == low.crps(TRUTH).tolist()
    assert better_prior_crps(TRUTH, (low, high), rows).tolist() == high.crps(TRUTH).tolist()
    assert crps_skill(high.crps(TRUTH), both).value < 0.0


def test_calibration_finds_gain_and_offset_of_other_people():
    fitted = AffineCalibration.fit(0.4 * TRUTH + 0.1, TRUTH, ALIKE)
    assert fitted(0.4 * TRUTH + 0.1) == pytest.approx(TRUTH)
    assert (fitted([-5.0, 5.0]) == (0.0, 1.0)).all()
    assert np.isnan(fitted(np.nan))


def test_calibration_of_what_tells_nothing_is_the_best_constant():
    for estimate in (np.full(2000, 0.7), RNG.standard_normal(2000)):
        fitted = AffineCalibration.fit(estimate, TRUTH, ALIKE)
        assert fitted(estimate) == pytest.approx(np.full(2000, TRUTH.mean()), abs=0.05)


def test_calibration_uses_known_rows_alone():
    estimate = np.where(TRUTH > 0.5, np.nan, 2.0 * TRUTH)
    assert AffineCalibration.fit(estimate, TRUTH, ALIKE).slope == pytest.approx(0.5)
    with pytest.raises(InputError, match="nothing to be calibrated"):
        AffineCalibration.fit(np.full(2000, np.nan), TRUTH, ALIKE)


def scored(entry, oracle=0.04, people=20):
    """Return squared errors of calibrated (about 0.16), entry and oracle."""
    rng = np.random.default_rng(9)
    levels = np.array([0.16, entry, oracle])
    return People(levels * rng.uniform(0.8, 1.2, (people, 3)), np.repeat(["a", "b"], people // 2))


def test_half_the_gap_in_rmse():
    found = gap_closed(scored(0.09), root=True)
    assert found.share is not None
    assert found.share.value == pytest.approx(0.5, abs=0.06)
    assert found.share.low < 0.5 < found.share.high
    assert found.gap.value == pytest.approx(0.2, abs=0.02)
    assert not found.beats_oracle


def test_scores_that_are_no_squares_take_no_root():
    found = gap_closed(scored(0.10), root=False)
    assert found.share is not None
    assert found.share.value == pytest.approx(0.5, abs=0.06)


def test_a_gap_of_nothing_has_no_shares():
    found = gap_closed(scored(0.09, oracle=0.16), root=True)
    assert found.share is None
    assert found.difference.low > 0.0


def test_who_is_worse_than_calibrated_closes_nothing_even_if_the_oracle_is_worse_still():
    found = gap_closed(scored(0.25, oracle=0.36), root=True)
    assert found.share is None
    assert found.difference.high < 0.0


def test_an_entry_that_beats_the_oracle_is_said_to():
    assert gap_closed(scored(0.02), root=True).beats_oracle


def test_three_scores_a_person():
    with pytest.raises(InputError, match="calibrated, entry and oracle"):
        gap_closed(People(np.ones((4, 2)), np.array([*"aabb"])), root=True)
