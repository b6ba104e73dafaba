"""Bad estimators against an honest one: each is shown by a score, and lying improves none."""

import numpy as np
import pytest

from cowalk.estimation import (
    Prior,
    bias,
    central_interval,
    coverage,
    crps,
    crps_skill,
    lag,
    overshoot,
    rise_time,
    rmse,
)

PERIOD = 0.05
N = 1200
RNG = np.random.default_rng(8)
PEOPLE = np.repeat([[0.2, 0.6, 0.3, 0.7]], 50, axis=0) + RNG.normal(0.0, 0.08, (50, 4))
TRUTHS = np.clip(np.repeat(PEOPLE, N // 4, axis=1), 0.0, 1.0)
"""Stubbornness of 50 people, in three steps."""
TRUTH = TRUTHS[0]
OTHERS = TRUTHS[1:].ravel()
PRIOR = Prior.fit(OTHERS, np.full(OTHERS.size, 1.0 / OTHERS.size))
HONEST = TRUTH + RNG.normal(0.0, 0.05, N)
STATED = np.full(N, 0.05)


def late(signal, rows):
    return np.concatenate((np.full(rows, signal[0]), signal[:-rows]))


ESTIMATORS = {
    "honest": (HONEST, STATED),
    "constant": (np.full(N, PRIOR.mean), np.full(N, OTHERS.std())),
    "late": (late(HONEST, 40), STATED),
    "lying": (HONEST, np.full(N, 1e-4)),
    "modest": (HONEST, np.full(N, 0.4)),
    "exaggerating": (np.clip(2.0 * HONEST, 0.0, 1.0), STATED),
}


def scores(name):
    """Return scores of which more is better, but for the last three."""
    mean, deviation = ESTIMATORS[name]
    within = coverage(TRUTH, *central_interval(mean, deviation, 0.9, (0.0, 1.0)))
    return {
        "skill": crps_skill(crps(TRUTH, mean, deviation, (0.0, 1.0)), PRIOR.crps(TRUTH)).value,
        "rmse": rmse(mean, TRUTH).value,
        "bias": abs(bias(mean, TRUTH).value),
        "lag": lag(mean, TRUTH, PERIOD),
        "off level": abs(within.value - 0.9),
        "width": within.width,
    }


BEST = scores("honest")


def test_the_honest_one_is_good_in_everything():
    assert BEST["skill"] > 0.7
    assert BEST["rmse"] == pytest.approx(0.05, abs=0.01)
    assert BEST["bias"] < 0.01
    assert BEST["lag"] == 0.0
    assert BEST["off level"] < 0.03


def test_a_constant_has_no_skill_no_lag_and_never_rises():
    found = scores("constant")
    assert abs(found["skill"]) < 0.2
    assert np.isnan(found["lag"])
    assert found["rmse"] > 3.0 * BEST["rmse"]
    assert found["width"] > 3.0 * BEST["width"]
    for step in ((0.2, 0.6), (0.6, 0.2)):
        assert rise_time(ESTIMATORS["constant"][0], *step, PERIOD) == np.inf


def test_a_late_one_is_as_late_as_it_is():
    found = scores("late")
    assert found["lag"] == pytest.approx(2.0)
    assert found["skill"] < BEST["skill"]
    assert found["off level"] > BEST["off level"]


@pytest.mark.parametrize("name", ["lying", "modest"])
def test_a_wrong_deviation_improves_nothing(name):
    found = scores(name)
    assert found["skill"] < BEST["skill"]
    assert found["off level"] > BEST["off level"] + 0.05
    assert (found["rmse"], found["bias"], found["lag"]) == tuple(
        BEST[score] for score in ("rmse", "bias", "lag")
    )


def test_certainty_that_is_claimed_scores_as_the_bare_error():
    mean, deviation = ESTIMATORS["lying"]
    claimed = crps(TRUTH, mean, deviation, (0.0, 1.0)).mean()
    assert claimed == pytest.approx(np.abs(np.clip(HONEST, 0.0, 1.0) - TRUTH).mean(), rel=0.01)


def test_who_exaggerates_is_biased_and_overshoots():
    found = scores("exaggerating")
    assert found["bias"] > 0.2
    assert found["skill"] < 0.0
    step = TRUTH[N // 4 - 1], TRUTH[N // 4]
    after = slice(N // 4, N // 2)
    assert overshoot(ESTIMATORS["exaggerating"][0][after], *step) > 0.5
