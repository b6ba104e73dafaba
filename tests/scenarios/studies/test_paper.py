"""The paper's reported numbers, and the search for the constants it does not print."""

import numpy as np
import pytest

from cowalk.scenarios.files.loading import load
from cowalk.scenarios.studies import calibration
from cowalk.scenarios.studies.paper import REPORTED, SCENARIO, constants, measure, reproduce, rows


@pytest.mark.parametrize("row", reproduce(), ids=lambda row: row.name)
def test_every_reported_number_is_met(row):
    assert row.passed, row
    assert abs(row.ours - row.reported) <= row.tolerance


def test_tolerances_are_the_stated_ones():
    stated = {"1": 0.03, "s": 0.7, "m": 0.04}
    assert all(row.tolerance == stated[row.unit] for row in REPORTED.values())


def test_the_scenario_reads_the_paper_to_the_letter():
    scenario = load(SCENARIO)
    smoother = scenario.automation.smoother
    assert (smoother.name, smoother.parameters) == ("moving-average", {"window": 5})
    assert scenario.automation.name == "stubbornness"
    assert scenario.plant.name == "unicycle"
    assert scenario.pace == 0.8
    assert scenario.automation.negotiation.dimensions == "omega"


def test_another_set_of_constants_does_not_reproduce_the_paper():
    measured = calibration.simulate(np.array([0.5]), np.array([1.0]), np.array([0.4]))
    verdicts = rows({key: value[0] for key, value in measured.items()})
    assert not all(row.passed for row in verdicts)


def test_the_batch_simulation_of_the_search_is_the_scenario_that_runs():
    ours = constants()
    measured = calibration.simulate(
        np.array([ours["omega_ub = -omega_lb, rad/s"]]),
        np.array([ours["horizon tau, s"]]),
        np.array([ours["w3/w1, m^2 s^2/rad^2"]]),
    )
    run = {row.name: row.ours for row in reproduce()}
    for key, reported in REPORTED.items():
        # The search looks at y once a negotiation, the run at every control step.
        within = 3e-3 if key == "largest_y" else 1e-6
        assert measured[key][0] == pytest.approx(run[reported.name], abs=within)


def test_a_short_search_improves_on_its_first_generation(monkeypatch):
    scores = []
    plain = calibration.deviation

    def watched(measured):
        score = plain(measured)
        scores.append(score.min())
        return score

    monkeypatch.setattr(calibration, "deviation", watched)
    monkeypatch.setattr(calibration, "GENERATIONS", 6)
    calls = []
    found, verdicts = calibration.calibrate(seed=5, progress=lambda *at: calls.append(at))
    assert set(found) == set(calibration.SEARCHED)
    for name, (low, high) in calibration.SEARCHED.items():
        assert low <= found[name] <= high
    assert min(scores[1:]) < scores[0]
    assert calls == [(k, 6) for k in range(1, len(calls) + 1)]
    assert len(verdicts) == len(REPORTED)


def test_measure_finds_a_knee_and_a_crossing_by_hand():
    time = np.arange(0.0, 45.0, 0.7)
    utility = np.interp(time, [12.0, 15.5, 33.0], [1.0, 0.7, 0.5])
    wish = np.where(time < 34.0, -0.1, 0.0)
    omega = np.zeros_like(time)
    found = measure(time, np.full_like(time, 0.4), utility, omega, wish, time * 0.0, 0.2)
    assert found["steep_until"] == pytest.approx(15.5, abs=0.7)
    assert found["agrees"] == pytest.approx(34.3)
