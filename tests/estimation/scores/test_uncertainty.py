import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.stats import norm

from cowalk.estimation import central_interval, coverage, crps, crps_discrete, crps_skill
from cowalk.sim.basics.errors import InputError

ENDS = (0.0, 1.0)
SHARES = st.floats(0.0, 1.0)


@given(truth=SHARES, mean=st.floats(-0.2, 1.2), deviation=st.floats(0.02, 3.0))
def test_the_closed_form_is_the_integral(truth, mean, deviation):
    below, _ = quad(lambda x: norm.cdf(x, mean, deviation) ** 2, 0.0, truth)
    above, _ = quad(lambda x: norm.sf(x, mean, deviation) ** 2, truth, 1.0)
    assert crps(truth, mean, deviation, ENDS) == pytest.approx(below + above, abs=1e-6)


def test_without_ends_it_is_the_score_of_the_normal_distribution():
    # Gneiting and Raftery 2007: at its own mean, d (sqrt(2) - 1)/sqrt(pi).
    at_mean = (np.sqrt(2.0) - 1.0) / np.sqrt(np.pi)
    assert crps(3.0, 3.0, 2.0) == pytest.approx(2.0 * at_mean)


@given(truth=SHARES, mean=SHARES)
def test_an_estimate_without_uncertainty_scores_its_error(truth, mean):
    wanted = pytest.approx(abs(mean - truth), abs=1e-9)
    assert crps(truth, mean, 0.0, ENDS) == wanted
    assert crps(truth, mean, np.nan, ENDS) == wanted
    assert crps(truth, mean, 1e-12, ENDS) == wanted


def test_unknown_rows_stay_unknown_and_a_negative_deviation_is_refused():
    assert np.isnan(crps([0.5, np.nan], [np.nan, 0.5], 0.1, ENDS)).all()
    with pytest.raises(InputError, match="at least 0"):
        crps(0.5, 0.5, -0.1)


@pytest.mark.parametrize("factor", [0.3, 0.6, 1.6, 3.0])
@pytest.mark.parametrize("name", ["uniform", "narrow", "at an end"])
def test_stating_too_much_or_too_little_does_not_pay(name, factor):
    rng = np.random.default_rng(0)
    truth = {
        "uniform": rng.uniform(size=4000),
        "narrow": np.clip(rng.normal(0.5, 0.08, 4000), 0.0, 1.0),
        "at an end": np.clip(rng.normal(0.0, 0.2, 4000), 0.0, 1.0),
    }[name]
    mean, deviation = truth.mean(), truth.std()
    honest = crps(truth, mean, deviation, ENDS).mean()
    assert crps(truth, mean, factor * deviation, ENDS).mean() > honest


def test_a_grid_scores_as_the_normal_distribution_that_it_samples():
    values = np.linspace(-1.0, 2.0, 3001)
    weights = norm.pdf(values, 0.4, 0.1)
    found = crps_discrete([0.1, 0.4, 0.9], values, weights)
    assert found == pytest.approx(crps([0.1, 0.4, 0.9], 0.4, 0.1), abs=1e-4)
    assert crps_discrete(0.7, [0.2], [1.0]) == pytest.approx(0.5)


def test_each_row_may_have_a_grid_of_its_own():
    weights = [[1.0, 0.0], [0.0, 3.0], [1.0, 1.0]]
    assert crps_discrete([0.0, 0.0, 0.0], [0.0, 1.0], weights) == pytest.approx([0.0, 1.0, 0.25])


class TestSkill:
    truth = np.random.default_rng(2).uniform(size=400)
    prior = crps_discrete(truth, np.linspace(0.0, 1.0, 51), np.ones(51))

    def test_the_prior_has_none_and_the_truth_all(self):
        assert crps_skill(self.prior, self.prior).value == 0.0
        assert crps_skill(np.zeros(400), self.prior) == (1.0, 1.0)

    def test_silence_neither_costs_nor_earns(self):
        assert crps_skill(np.full(400, np.nan), self.prior).value == 0.0

    def test_choosing_rows_by_difficulty_earns_no_more_than_saying_the_prior_there(self):
        score = crps(self.truth, np.full(400, 0.5), np.nan, ENDS)
        easy = np.abs(self.truth - 0.5) < 0.05
        chosen = crps_skill(np.where(easy, score, np.nan), self.prior)
        assert chosen.value == crps_skill(np.where(easy, score, self.prior), self.prior).value
        assert 0.0 < chosen.value < 0.1
        assert chosen.share == 1.0

    def test_a_constant_said_to_be_certain_is_worse_than_the_prior(self):
        assert crps_skill(crps(self.truth, 0.5, 1e-6, ENDS), self.prior).value < -0.3

    def test_rows_where_the_prior_knows_no_truth_do_not_count(self):
        prior = np.where(np.arange(400) < 100, self.prior, np.nan)
        value, share = crps_skill(0.5 * self.prior, prior)
        assert value == pytest.approx(0.5)
        assert share == 0.25

    def test_without_rows_there_is_none(self):
        assert np.isnan(crps_skill(self.prior, self.prior, np.zeros(400, dtype=bool)).value)


@pytest.mark.parametrize("level", [0.5, 0.9])
def test_honest_intervals_hold_the_truth_as_often_as_they_say(level):
    rng = np.random.default_rng(1)
    mean = rng.uniform(0.3, 0.7, 20000)
    truth = rng.normal(mean, 0.05)
    found = coverage(truth, *central_interval(mean, np.full(20000, 0.05), level, ENDS))
    assert found.value == pytest.approx(level, abs=0.01)
    assert found.width == pytest.approx(2.0 * 0.05 * norm.ppf(0.5 + level / 2.0), rel=0.01)


def test_who_says_everything_is_possible_is_shown_by_the_width():
    truth = np.random.default_rng(1).uniform(size=100)
    found = coverage(truth, *central_interval(np.full(100, 0.5), np.full(100, 9.0), 0.5, ENDS))
    assert found == (1.0, 1.0, 1.0)


def test_who_claims_certainty_covers_nothing():
    truth = np.random.default_rng(1).uniform(size=100)
    low, high = central_interval(np.full(100, 0.5), np.full(100, np.nan), 0.9, ENDS)
    assert coverage(truth, low, high) == (0.0, 0.0, 1.0)


def test_coverage_rests_on_rows_that_are_asked_for_and_known():
    truth = np.array([0.1, 0.5, np.nan, 0.5])
    found = coverage(truth, np.full(4, 0.4), np.full(4, 0.6), [True, True, True, False])
    assert found.value == 0.5
    assert found.width == pytest.approx(0.2)
    assert found.share == 0.5


def test_a_level_is_a_share():
    with pytest.raises(InputError, match="between 0 and 1"):
        central_interval(0.5, 0.1, 90)
