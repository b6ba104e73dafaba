import numpy as np
import pytest

from cowalk.scenarios import definitions, load, metrics, run
from cowalk.scenarios.measures.disagreement import Extent
from cowalk.scenarios.trace.columns import UNITS
from cowalk.sim import Path, Situation, TwistBounds

PERIOD = 0.05
BOUNDS = TwistBounds((0.0, -0.5), (1.2, 0.5))
SITUATION = Situation(Path(((0.0, 0.0), (20.0, 0.0))), 0.8, BOUNDS, PERIOD)


def columns(rows=200, **given):
    base = {name: np.zeros(rows) for name in UNITS}
    base["t"] = (np.arange(rows) + 1) * PERIOD
    base["identifiable_v"] = base["identifiable_omega"] = np.ones(rows)
    return base | {name: np.asarray(value, dtype=float) for name, value in given.items()}


def values(things=(), **given):
    rows = len(next(iter(given.values()))) if given else 200
    found = metrics(columns(rows, **given), SITUATION, things=things)
    return {name: entry["value"] for name, entry in found.items()}


def test_every_metric_is_defined_and_has_its_unit():
    found = metrics(columns(), SITUATION)
    assert list(found) == list(definitions())
    assert {name: entry["unit"] for name, entry in found.items()} == {
        name: each.unit for name, each in definitions().items()
    }
    assert all(0.0 <= entry["share"] <= 1.0 for entry in found.values())


def test_effort_of_a_constant_push_forward_and_sideways_apart_intended_and_true():
    push = {"fx_intent": np.full(200, -3.0), "fy_intent": np.full(200, 4.0)}
    push |= {"interaction_force_x": np.full(200, -6.0), "interaction_force_y": np.full(200, 8.0)}
    found = values(**push, x=np.linspace(0.0, 4.0, 200))
    assert found["intended effort"] == pytest.approx(5.0 * 10.0)
    assert found["intended effort, forward"] == pytest.approx(3.0 * 10.0)
    assert found["squared intended effort, sideways"] == pytest.approx(16.0 * 10.0)
    assert found["true effort"] == pytest.approx(10.0 * 10.0)
    assert found["peak true force"] == pytest.approx(10.0)
    assert found["intended effort a metre"] == pytest.approx(5.0 * 10.0 / 4.0)


def test_who_gets_nowhere_has_no_effort_by_the_metre_and_no_arrival():
    found = values(fx_intent=np.ones(200))
    assert np.isnan(found["intended effort a metre"])
    assert np.isnan(found["arrival time"])
    x = np.linspace(0.0, 25.0, 200)
    found = values(x=x)
    assert found["arrival time"] == pytest.approx(PERIOD * (1 + np.argmax(x >= 20.0)))


def test_a_disagreement_about_v_counts_though_omega_agrees():
    found = values(true_v=np.zeros(200), v=np.full(200, 0.8))
    assert found["time apart, v"] == pytest.approx(10.0)
    assert found["time apart, omega"] == 0.0
    assert found["unresolved, v"] == 1.0
    assert found["disagreement, v"] == pytest.approx(0.8)
    assert found["executed concession, omega"] != 1.0


def test_a_wish_beyond_the_bounds_is_the_wish_for_the_bound():
    found = values(true_omega=np.full(200, 5.0), omega=np.full(200, 0.5))
    assert found["time apart, omega"] == 0.0


def test_what_nobody_knows_is_nan_with_no_rows():
    unknown = np.full(200, np.nan)
    truth = ("true_v", "true_omega", "true_stubbornness_v", "true_stubbornness_omega")
    found = metrics(columns(**dict.fromkeys(truth, unknown)), SITUATION)
    for name in ("time apart", "disagreement", "disagreements", "stubbornness RMSE"):
        for dimension in ("v", "omega"):
            entry = found[f"{name}, {dimension}"]
            assert np.isnan(entry["value"]), name
            assert entry["share"] == 0.0
    assert np.isnan(found["executed concession, omega"]["value"])
    assert np.isnan(found["response lag, omega"]["value"])


def test_conflict_is_not_known_where_the_drive_is_not():
    push = np.full(200, 5.0)
    drive = np.concatenate((np.full(100, -5.0), np.full(100, 5.0)))
    assert values(fx_intent=push, drive_force=drive)["conflict share, v"] == pytest.approx(0.5)
    unknown = np.full(200, np.nan)
    assert np.isnan(values(fx_intent=push, drive_force=unknown)["conflict share, v"])


def test_the_automations_own_wish_is_not_taken_from_its_report():
    """Else whoever reports the human's wish as its own would have conceded everything."""
    course = {"true_omega": np.full(200, 0.4), "v": np.full(200, 0.8), "v_cmd": np.full(200, 0.8)}
    honest = values(**course)
    liar = values(**course, wish_omega=np.full(200, 0.4), est_omega=np.full(200, 0.4))
    assert honest["executed concession, omega"] == pytest.approx(0.0)
    assert liar["executed concession, omega"] == pytest.approx(0.0)


def test_claiming_agreement_is_no_right_estimate_of_a_wish():
    omega = np.zeros(200)
    course = {"true_omega": np.full(200, 0.4), "negotiated": np.ones(200)}
    assert values(**course, est_omega=omega)["wish direction, omega"] == 0.0
    assert values(**course, est_omega=omega + 0.1)["wish direction, omega"] == 1.0


def test_certainty_is_judged_by_what_it_covers():
    course = {"true_omega": np.full(200, 0.4), "true_stubbornness_omega": np.full(200, 0.5)}
    sure, unsure = np.zeros(200), np.full(200, 0.3)
    name = "stubbornness coverage, omega"
    assert values(**course, est_stubbornness_deviation_omega=sure)[name] == 0.0
    assert values(**course, est_stubbornness_deviation_omega=unsure + 0.1)[name] == 1.0
    silent = np.full(200, np.nan)
    assert np.isnan(values(**course, est_stubbornness_deviation_omega=silent)[name])


def test_outcomes_are_shares_of_the_disagreements():
    rows = np.arange(400)
    wish = np.where((rows >= 100) & (rows < 180), 0.4, 0.0)
    x = 0.04 * rows
    found = values((Extent(9.0, 10.0),), true_omega=wish, x=x)
    assert found["disagreements, omega"] == 1.0
    assert found["given in, omega"] == 1.0
    found = values((Extent(6.0, 6.5),), true_omega=wish, x=x)
    assert found["ended after it, omega"] == 1.0
    assert np.isnan(values(x=x)["resolved in time, omega"])


@pytest.mark.parametrize("name", ["puddle", "doorway"])
def test_a_run_tells_how_near_it_came_to_each_thing(name):
    result = run(load(name))
    found = {
        key: entry["value"]
        for key, entry in result.summary["metrics"].items()
        if key.startswith("clearance to ")
    }
    world = result.scenario.world
    things = len(world.obstacles) + len(world.furniture) + len(world.pedestrians)
    assert len(found) == things
    least = result.summary["metrics"]["smallest clearance"]["value"]
    assert min(found.values()) >= least - 1e-3
    if name == "puddle":  # where nothing else is as near
        assert found["clearance to obstacles.0"] == pytest.approx(least, abs=2e-3)
