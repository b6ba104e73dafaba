import numpy as np
import pytest

from cowalk.scenarios.trace.columns import UNITS
from cowalk.scenarios.trace.metrics import metrics
from cowalk.sim.basics.path import Path

PERIOD = 0.05
PATH = Path(((0.0, 0.0), (10.0, 0.0)))


def columns(rows=200, **given):
    base = {name: np.zeros(rows) for name in UNITS}
    base["t"] = (np.arange(rows) + 1) * PERIOD
    base["target_utility"][:] = 1.0
    return base | {name: np.asarray(value, dtype=float) for name, value in given.items()}


def value(name, **given):
    return metrics(columns(**given), PERIOD, PATH)[name]["value"]


def test_effort_and_work_of_a_constant_push():
    push = {"fx": np.full(200, 3.0), "fy": np.full(200, 4.0), "v": np.full(200, 0.5)}
    assert value("mean force", **push) == pytest.approx(5.0)
    assert value("effort", **push) == pytest.approx(5.0 * 10.0)
    assert value("interaction work", **push) == pytest.approx(3.0 * 0.5 * 10.0)
    assert value("distance walked", **push) == pytest.approx(5.0)


def test_time_to_agreement_counts_from_the_first_disagreement_to_the_first_that_is_held():
    wish = np.zeros(200)
    wish[20:60] = 0.3
    wish[70:80] = 0.3  # an agreement of half a second does not count
    assert value("time to agreement", true_omega=wish) == pytest.approx(60 * PERIOD)
    assert value("time to agreement") == 0.0
    assert np.isnan(value("time to agreement", true_omega=np.full(200, 0.3)))


def test_stubbornness_scores():
    truth = np.linspace(0.0, 1.0, 200)
    scores = {"true_stubbornness_omega": truth, "est_stubbornness_omega": truth - 0.25}
    assert value("stubbornness RMSE", **scores) == pytest.approx(0.25)
    assert value("stubbornness bias", **scores) == pytest.approx(-0.25)


def test_offset_keeps_its_sign_and_missing_opinions_are_left_out():
    y = np.zeros(200)
    y[50], y[100] = 0.3, -0.6
    assert value("largest lateral offset", y=y) == pytest.approx(-0.6)
    utility = np.full(200, np.nan)
    assert np.isnan(value("lowest target utility", target_utility=utility))
    utility[3] = 0.4
    assert value("lowest target utility", target_utility=utility) == pytest.approx(0.4)
