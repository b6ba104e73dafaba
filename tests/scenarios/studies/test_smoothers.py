import pytest

from cowalk.estimation.registry import SMOOTHERS
from cowalk.scenarios.files.loading import load
from cowalk.scenarios.studies.smoothers import compare_smoothers
from cowalk.sim.basics.errors import InputError

QUICK = ("plant=unicycle", "duration=12", "sensor.noise_density=0.0365")


def test_every_smoother_is_scored_the_papers_first():
    calls = []
    scores = compare_smoothers(load("puddle", QUICK), 2, lambda *at: calls.append(at), jobs=1)
    assert next(score.smoother for score in scores) == "moving-average"
    assert {score.smoother for score in scores} == set(SMOOTHERS)
    assert all(score.runs == 2 for score in scores)
    assert all(0.0 < score.rmse < 1.0 for score in scores)
    assert all(score.rmse_spread > 0.0 for score in scores)
    assert all(score.delay >= 0.0 for score in scores)  # each smoother is causal
    total = 2 * len(scores)
    assert calls == [(done, total) for done in range(1, total + 1)]


def test_one_core_and_many_agree():
    one = compare_smoothers(load("puddle", QUICK), 1, jobs=1)
    assert compare_smoothers(load("puddle", QUICK), 1, jobs=2) == one


def test_at_least_one_seed():
    with pytest.raises(InputError, match="at least 1"):
        compare_smoothers(load("puddle"), 0)
