"""Disagreements that are made: who moved, and whether before the thing or after it."""

import numpy as np
import pytest

from cowalk.scenarios import apart, disagreements
from cowalk.scenarios.measures.disagreement import Extent, episodes, things_of
from cowalk.sim import Obstacle, Path, World

PERIOD = 0.05
ROWS = np.arange(400)
STATION = 0.04 * ROWS  # 0.8 m/s
THING = (Extent(9.0, 10.0),)  # rows 225 to 250


def held(first, last, level=0.4):
    return np.where((first <= ROWS) & (last > ROWS), level, 0.0)


def outcomes(wish, executed, things=THING):
    rows = apart(wish, executed, 0.5)
    return [each.outcome for each in disagreements(wish, executed, rows, STATION, things, PERIOD)]


@pytest.mark.parametrize(
    ("wish", "executed", "outcome"),
    [
        (held(150, 400), held(200, 400), "resolved in time"),
        (held(150, 200), 0.0 * ROWS, "given in"),
        (held(150, 400), held(240, 400), "ended at it"),
        (held(150, 240), 0.0 * ROWS, "ended at it"),
        (held(150, 270), 0.0 * ROWS, "ended after it"),
        (held(150, 400), 0.0 * ROWS, "unresolved"),
    ],
)
def test_an_outcome_says_who_moved_and_when(wish, executed, outcome):
    assert outcomes(wish, executed) == [outcome]
    assert outcomes(-wish, -executed) == [outcome]


def test_who_never_yields_resolves_nothing_though_it_is_over_sooner():
    """Time to agreement alone said the opposite: 50 rows against 80."""
    never = outcomes(held(180, 230), 0.0 * ROWS)
    yielding = outcomes(held(120, 400), held(200, 400))
    assert (never, yielding) == (["ended at it"], ["resolved in time"])


def test_every_episode_counts_not_the_first_alone():
    wish = held(20, 60) + held(120, 160)
    executed = held(40, 60)
    assert outcomes(wish, executed) == ["resolved in time", "given in"]


def test_wanting_more_and_wanting_less_are_two():
    wish = held(100, 140) - held(140, 180)
    assert outcomes(wish, 0.0 * ROWS, ()) == ["given in", "given in"]


def test_gait_makes_no_disagreement_and_ends_none():
    sway = 0.3 * np.sin(2.0 * np.pi * 0.9 * PERIOD * ROWS)
    assert len(outcomes(held(100, 200) + sway * (ROWS > 100) * (ROWS < 200), 0.0 * ROWS)) == 1
    short = held(100, 105) + held(200, 206)
    assert outcomes(short, 0.0 * ROWS) == []


def test_breaks_are_bridged_before_short_ones_are_left_out():
    rows = np.zeros(100, bool)
    rows[10:14] = rows[20:30] = rows[60:65] = True
    assert episodes(rows, PERIOD) == [(10, 29)]


def test_it_is_about_the_next_thing_that_the_human_sees():
    seen = Obstacle(9.0, -0.5, 0.35, seen_by=("human",))
    unseen = Obstacle(5.0, 0.0, 0.3, seen_by=("automation",))
    world = World(Path(((0.0, 0.0), (20.0, 0.0))), obstacles=(unseen, seen))
    assert things_of(world) == [Extent(8.65, 9.35)]
    rows = apart(held(150, 200), 0.0 * ROWS, 0.5)
    far = Extent(30.0, 31.0)
    (one,) = disagreements(held(150, 200), 0.0 * ROWS, rows, STATION, (far, *THING), PERIOD)
    assert one.about == THING[0]
    (one,) = disagreements(held(150, 200), 0.0 * ROWS, rows, STATION, (far,), PERIOD)
    assert one.about is None
