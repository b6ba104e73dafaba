"""Human models along a whole walk: what one encounter leaves for the next."""

import pytest

from cowalk.scenarios import load, run

PUDDLE = "{{kind: puddle, x: {}, y: -0.75, radius: 0.35, seen_by: [human]}}"
TWO_PUDDLES = (
    "plant=unicycle",
    "sensor=none",
    "duration=45.0",
    "human.parameters={}",
    "world.path.points=[[0, 0], [36, 0]]",
    f"world.obstacles=[{PUDDLE.format(9.0)}, {PUDDLE.format(21.0)}]",
)


def test_tit_for_tat_insists_at_the_second_puddle_as_at_the_first():
    trace = run(load("puddle", ["human.name=tit-for-tat", *TWO_PUDDLES])).trace
    x, clearance, level = trace["x"], trace["clearance"], trace["true_stubbornness_omega"]
    assert ((level >= 0.0) & (level <= 1.0)).all()
    first, second = (x > 3.0) & (x < 14.0), (x > 15.0) & (x < 26.0)
    assert level[second].max() == pytest.approx(level[first].max(), abs=0.05)
    assert level[second].mean() == pytest.approx(level[first].mean(), abs=0.1)
    for around in (first, second):
        assert clearance[around].min() > 0.0
