"""Estimators in the loop, scored: those that ship, and one's own."""

from dataclasses import asdict

import numpy as np
import pytest

from cowalk.estimation import FRONT_ENDS, OBSERVERS, SMOOTHERS
from cowalk.scenarios.files.loading import load
from cowalk.scenarios.studies.estimators import compare_estimators, compare_smoothers
from cowalk.sim.basics.errors import InputError

QUICK = ("plant=unicycle", "duration=12", "sensor.noise_density=0.0365")


def test_every_smoother_is_scored_the_papers_first():
    calls = []
    scores = compare_smoothers(
        load("puddle", QUICK), seeds=2, progress=lambda *at: calls.append(at), jobs=1
    )
    assert next(score.name for score in scores) == "moving-average"
    assert {score.name for score in scores} == set(SMOOTHERS)
    assert all(score.runs == 2 for score in scores)
    assert all(0.0 < score.rmse < 1.0 for score in scores)
    assert all(score.rmse_spread > 0.0 for score in scores)
    assert all(score.delay >= 0.0 for score in scores)  # each smoother is causal
    total = 2 * len(scores)
    assert calls == [(done, total) for done in range(1, total + 1)]


def test_one_core_and_many_agree():
    one = compare_smoothers(load("puddle", QUICK), seeds=1, jobs=1)
    two = compare_smoothers(load("puddle", QUICK), seeds=1, jobs=2)
    np.testing.assert_equal([asdict(score) for score in two], [asdict(score) for score in one])


def test_at_least_one_seed():
    with pytest.raises(InputError, match="at least 1"):
        compare_smoothers(load("puddle"), seeds=0)


@pytest.mark.parametrize(
    ("kind", "registry", "first"),
    [("observer", OBSERVERS, "paper"), ("front end", FRONT_ENDS, "none")],
)
def test_every_observer_and_front_end_is_scored(kind, registry, first):
    scores = compare_estimators(load("puddle", QUICK), kind, seeds=1, jobs=1)
    assert next(score.name for score in scores) == first
    assert {score.name for score in scores} == set(registry)
    assert all(0.0 < score.rmse < 1.0 and 0.0 < score.wish_rmse < 1.0 for score in scores)


OWN = """
import numpy as np
from cowalk.estimation import Estimate

class Shy:
    reads_force = False
    def reset(self, situation, reading, rng):
        pass
    def update(self, sample, own_wish):
        return Estimate(np.zeros(2), own_wish)
"""


def test_ones_own_stands_beside_those_that_ship(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "shy_observers.py").write_text(OWN)
    scores = compare_estimators(load("puddle", QUICK), "observer", ["shy_observers:Shy"], 1, jobs=2)
    assert [score.name for score in scores] == ["paper", "shy_observers:Shy"]
    shy = scores[1]
    assert shy.bias == pytest.approx(-shy.rmse, rel=0.5)
    with pytest.raises(InputError, match="unknown observer 'papre'; did you mean 'paper'"):
        compare_estimators(load("puddle", QUICK), "observer", ["papre"], 1)
