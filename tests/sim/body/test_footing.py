"""What shoes hold: Coulomb's law in any direction, and when the footing is lost."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim.body.footing import LOST_SPEED, Footing

STEP = 1.0 / 80.0
FORCE = st.floats(-2000.0, 2000.0)


@given(FORCE, FORCE, st.floats(0.05, 1.5), st.floats(20.0, 200.0))
def test_below_it_nothing_changes_and_beyond_only_the_size(x, y, traction, mass):
    most = traction * mass * 9.81
    given_x, given_y = Footing(traction, mass, STEP).bear(x, y)
    asked = math.hypot(x, y)
    if asked <= most * (1.0 - 1e-12):
        assert (given_x, given_y) == (x, y)
    else:
        assert math.hypot(given_x, given_y) == pytest.approx(min(asked, most))
        assert given_x * y == pytest.approx(given_y * x)
        assert given_x * x + given_y * y > 0.0


def steps_until_lost(asked, footing):
    """Return after how many steps of a force, N, the footing is lost; at most 1000."""
    for step in range(1, 1001):
        footing.bear(asked, 0.0)
        if not footing.held:
            return step
    return None


@pytest.mark.parametrize("excess", [50.0, 300.0, 3000.0])
def test_it_is_lost_once_the_floor_fails_to_give_half_a_metre_a_second(excess):
    footing = Footing(0.5, 70.0, STEP)
    expected = LOST_SPEED * 70.0 / excess / STEP
    assert steps_until_lost(footing.most + excess, footing) == math.floor(expected) + 1


def test_a_peak_is_caught_and_what_the_floor_has_to_spare_wins_it_back():
    footing = Footing(0.5, 70.0, STEP)
    for _ in range(1000):
        footing.bear(footing.most + 200.0, 0.0)
        footing.bear(0.0, footing.most - 210.0)
    assert footing.held
    assert steps_until_lost(footing.most, footing) is None
    for _ in range(1000):
        footing.bear(footing.most + 200.0, 0.0)
        footing.bear(0.0, footing.most - 190.0)
    assert not footing.held
    footing.bear(0.0, 0.0)
    assert not footing.held, "lost is lost"
    footing.reset()
    assert footing.held


def test_it_goes_on_where_it_was_saved():
    footing, other = Footing(0.5, 70.0, STEP), Footing(0.5, 70.0, STEP)
    lost = steps_until_lost(600.0, Footing(0.5, 70.0, STEP))
    for _ in range(lost - 1):
        footing.bear(600.0, 0.0)
    other.restore(footing.save())
    assert steps_until_lost(600.0, other) == 1
    assert footing.held
