"""What a run says the seats were rewarded for."""

import json

import pytest

from cowalk.scenarios import load, run, write_run
from cowalk.sim.env.reward import TERMS


@pytest.mark.parametrize("name", ["puddle", "paper-open-loop"])
def test_the_summary_sums_what_the_trace_has_by_seat_and_term(name, tmp_path):
    scenario = load(name, ["reward.human.effort=3.0", "duration=14.0"])
    result = run(scenario)
    written = json.loads((write_run(result, tmp_path) / "summary.json").read_text())["reward"]
    for seat in ("human", "automation"):
        total, *terms = written[seat]
        assert (total, tuple(terms)) == ("total", TERMS)
        assert written[seat]["total"] == pytest.approx(result.trace[f"reward_{seat}"].sum())
        assert written[seat]["total"] == pytest.approx(sum(written[seat][term] for term in TERMS))
    assert written["human"]["effort"] == pytest.approx(3.0 * written["automation"]["effort"])
    assert written["human"]["effort"] < 0.0


def test_who_arrives_is_rewarded_once_and_who_collides_pays_once():
    arrived = run(load("walk")).summary
    assert arrived["end"] == "goal"
    assert arrived["reward"]["human"]["arrival"] == 1.0
    assert arrived["reward"]["human"]["collision"] == 0.0
