"""What a trace says of the human's truth, and in which rows stubbornness can be read."""

import numpy as np
import pyarrow.parquet as pq
import pytest

from cowalk.agents import Truth
from cowalk.estimation import demand, identifiable, insistence, row_before
from cowalk.scenarios import load, run
from cowalk.scenarios.trace.trace import Trace
from cowalk.sim.basics.errors import InputError

UPPER = np.array([1.2, 0.5])
DIMENSIONS = ("v", "omega")


def walk(*changes, human="steady"):
    parts = ["plant=unicycle", f"human={human}", "expect={}", "duration=15"]
    result = run(load("puddle", [*parts, *changes]))
    assert result.error is None, result.error
    return result


def pairs(trace, name):
    prefix = f"{name}_" if name else ""
    return np.stack([trace[f"{prefix}{dimension}"] for dimension in DIMENSIONS], axis=-1)


def intent(trace):
    return np.stack((trace["fx_intent"], trace["fy_intent"]), axis=-1)


@pytest.fixture(scope="module")
def impedance():
    return walk(human="impedance")


def test_the_wish_of_a_spring_stays_within_the_bounds(impedance):
    wish = pairs(impedance.trace, "true")
    assert ((wish >= (0.0, -0.5)) & (wish <= UPPER)).all()
    assert np.ptp(wish[:, 1]) > 0.3
    # What they push for beyond it is insistence.
    assert impedance.trace["true_insistence_omega"].max() == 1.0


@pytest.mark.parametrize("human", ["open-loop", "recorded"])
def test_of_a_prescribed_force_only_insistence_is_known(human, stand_in_recording):
    given = {
        "open-loop": "human.parameters.profile=[[2.0, 0.0, 3.0]]",
        "recorded": f"human.parameters.file={stand_in_recording}",
    }
    result = walk(given[human], human=human)
    trace = result.trace
    for name in ("true", "true_stubbornness", "true_demand"):
        assert np.isnan(pairs(trace, name)).all()
    assert not pairs(trace, "identifiable").any()
    np.testing.assert_array_equal(pairs(trace, "true_insistence"), np.abs(intent(trace)) / 7.5)
    assert trace["true_insistence_omega"].max() > 0.2
    assert result.summary["person"] == {"gain": None, "force_max": [7.5, 7.5], "delay": 0.0}
    for name in ("time apart", "stubbornness RMSE", "smoothed stubbornness lag"):
        assert result.summary["metrics"][f"{name}, omega"]["value"] is None


def test_a_formula_about_a_wish_that_nobody_knows_fails_and_says_why():
    scenario = load("paper-open-loop", ["duration=5", "expect={x: always (true_omega < 9.0)}"])
    (verdict,) = run(scenario).verdicts
    assert not verdict.passed
    assert "true_omega" in verdict.reason


def test_columns_are_what_the_scores_say_of_them(impedance):
    trace = impedance.trace
    before = row_before(pairs(trace, ""))
    shares, wish = pairs(trace, "true_stubbornness"), pairs(trace, "true")
    np.testing.assert_allclose(
        pairs(trace, "true_demand")[1:], demand(shares, wish, before, UPPER)[1:]
    )
    np.testing.assert_allclose(pairs(trace, "true_insistence"), insistence(intent(trace), 7.5))
    rows = identifiable(
        trace["t"],
        shares,
        wish,
        before,
        intent(trace),
        lower=(0.0, -0.5),
        upper=UPPER,
        gain=2.0,
        force_limit=7.5,
    )
    np.testing.assert_array_equal(pairs(trace, "identifiable"), rows)
    assert 0.05 < rows[:, 1].mean() < 0.6


def test_where_nobody_disagrees_stubbornness_cannot_be_read():
    trace = walk("world.obstacles=[]").trace  # both want to go straight on
    assert np.abs(trace["true_omega"]).max() < 0.01
    assert not trace["identifiable_omega"].any()


def test_in_saturation_it_cannot_be_read_either():
    gentle, pressing = (
        walk(f"human.parameters={{level: [0.9, 0.9], gain: {gain}}}", "automation=never-yields")
        for gain in (0.5, 20.0)
    )
    assert gentle.trace["identifiable_omega"].mean() > 0.2
    trace = pressing.trace
    saturated = trace["true_insistence_omega"] > 0.999
    assert saturated.mean() > 0.2
    assert not trace["identifiable_omega"][saturated].any()


@pytest.mark.parametrize("limited", ["force-limit", "fatigue"])
def test_a_force_that_is_cut_tells_nothing_of_what_was_meant(limited):
    cut = {
        "force-limit": "{name: force-limit, parameters: {limit: 1.5}}",
        "fatigue": "{name: fatigue, parameters: {strength: 1.5}}",
    }[limited]
    free = walk("automation=never-yields").trace
    held = walk("automation=never-yields", f"human.imperfections=[{cut}]").trace
    # Noise moves the force about its limit: what is cut stays unreadable.
    noisy = f"human.imperfections=[{cut}, signal-dependent-noise]"
    shaky = walk("automation=never-yields", noisy).trace
    asked = np.hypot(free["fx_intent"], free["fy_intent"])
    for trace in (held, shaky):
        np.testing.assert_allclose(trace["true_omega"], free["true_omega"])  # nobody yields
        readable = trace["identifiable_omega"] > 0.0
        assert not readable[asked > 1.51].any()
        assert readable.any()
    lost = (free["identifiable_omega"] > 0.0) & (asked > 1.51)
    assert lost.mean() > 0.1


def test_a_parked_robot_leaves_much_to_be_read(monkeypatch, tmp_path):
    (tmp_path / "parking.py").write_text(
        "import numpy as np\n"
        "from cowalk.agents import Belief\n"
        "class Parked:\n"
        "    def reset(self, rng, situation): pass\n"
        "    def act(self, observation): return np.zeros(2)\n"
        "    def belief(self): return Belief()\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    trace = walk("automation=parking:Parked").trace
    judged = trace["t"] >= 3.0
    assert trace["identifiable_v"][judged].all()  # they want to walk, and it does not
    assert not trace["identifiable_v"][~judged].any()


@pytest.mark.parametrize(
    ("human", "delay"), [("steady", 0.2), ("crossover", 0.4)], ids=["hand", "hand and eye"]
)
def test_delays_add_up(human, delay):
    result = walk("human.imperfections=[reaction-delay]", human=human)
    assert result.summary["person"]["delay"] == pytest.approx(delay)
    trace, late = result.trace, round(delay / 0.05)
    readable = np.abs(trace["true_demand_omega"] * 2.0) < 1.0
    meant = (15.0 * trace["true_demand_omega"])[:-late][readable[:-late]]
    np.testing.assert_allclose(trace["fy_intent"][late:][readable[:-late]], meant, atol=1e-9)


def test_of_a_human_who_does_not_say_how_strong_they_are_nothing_is_scored(monkeypatch, tmp_path):
    (tmp_path / "quiet.py").write_text(
        "import numpy as np\n"
        "from cowalk.agents import Truth\n"
        "class Quiet:\n"
        "    def reset(self, rng, situation): pass\n"
        "    def act(self, observation): return 7.5 * (0.4 - observation['twist'])\n"
        "    def truth(self): return Truth(np.full(2, 0.4), np.full(2, 0.5))\n"
        "class Beyond(Quiet):\n"
        "    def truth(self): return Truth(np.array([0.8, 0.6]), np.full(2, 0.5))\n"
        "class Proud(Quiet):\n"
        "    def truth(self): return Truth(np.full(2, 0.4), np.full(2, 1.2))\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    trace = walk(human="quiet:Quiet").trace
    assert np.isfinite(trace["true_demand_omega"]).all()
    assert not trace["identifiable_omega"].any()
    assert np.isnan(trace["true_insistence_v"]).all()
    for name, said in (
        ("Beyond", "truth().wish in omega is 0.6 rad/s; it must be from -0.5 to 0.5 rad/s"),
        ("Proud", "truth().stubbornness in v is 1.2; it must be from 0 to 1"),
    ):
        result = run(load("puddle", ["plant=unicycle", f"human=quiet:{name}", "expect={}"]))
        assert said in result.error


def test_a_trace_of_before_is_read_with_what_it_lacks_unknown(tmp_path):
    file = tmp_path / "trace.parquet"
    walk("duration=1").trace.write(file)
    table = pq.read_table(file)
    new = [
        name
        for name in table.column_names
        if name.startswith(("true_demand", "true_insistence", "identifiable"))
    ]
    assert len(new) == 6
    older = table.drop_columns(new)
    pq.write_table(older, file)
    assert older.schema.metadata[b"cowalk.format"] == b"3"
    with pytest.raises(InputError, match="not a trace: it has no column true_demand_v"):
        Trace.read(file)
    pq.write_table(older.replace_schema_metadata({"cowalk.format": "2"}), file)
    trace = Trace.read(file)
    assert np.isnan(trace["identifiable_omega"]).all()
    assert np.isfinite(trace["true_omega"]).all()


def test_a_truth_needs_no_more_than_wish_and_stubbornness():
    truth = Truth(np.zeros(2), np.zeros(2))
    assert np.isnan(truth.strength).all()
    assert np.isnan(truth.gain)
    assert (truth.limit == np.inf).all()
    assert truth.delay == 0.0
