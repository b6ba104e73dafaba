import numpy as np
import pytest

from cowalk.estimation import crps_discrete, grid_moments, oracle, rmse
from cowalk.estimation.scores.references import GRID
from cowalk.sim.basics.errors import InputError

PERIOD, UPPER, NOISE = 0.05, 0.5, 0.3
T = np.arange(500) * PERIOD
MISSING = 0.3 * np.sin(T / 2.0) + 0.06
"""Disagreement as a share of the bound."""
STEPS = np.select([T < 8.0, T < 16.0], [0.2, 0.7], 0.35)
FLAT = np.ones(GRID.size)
TOLD = {"gain": (1.5, 2.0, 2.5), "force_max": (10.0, 7.5, 6.0)}
SPREAD = {
    "gain": np.repeat((1.2, 1.6, 2.0, 2.5), 4),
    "force_max": np.tile((4.0, 5.5, 7.5, 10.0), 4),
}


def pushed(stubbornness, missing=MISSING, delay=0, gain=2.0, force_max=7.5):
    meant = force_max * np.clip(gain * stubbornness * missing, -1.0, 1.0)
    heard = np.concatenate((np.zeros(delay), meant[: T.size - delay]))
    return heard + NOISE * np.random.default_rng(4).standard_normal(T.size)


def believe(force, missing=MISSING, prior=FLAT, **given):
    given = {"noise": NOISE, "period": PERIOD, **TOLD, **given}
    return oracle(force, UPPER * missing, np.zeros(T.size), UPPER, prior=prior, **given)


def error(beliefs, truth=STEPS):
    return rmse(grid_moments(beliefs)[0], truth, T > 1.0).value


def test_told_the_strength_it_follows_steps():
    beliefs = believe(pushed(STEPS))
    assert beliefs.sum(axis=-1) == pytest.approx(np.ones(T.size))
    assert error(beliefs) < 0.08
    score = crps_discrete(STEPS, GRID, beliefs).mean()
    assert score < 0.3 * crps_discrete(STEPS, GRID, FLAT).mean()


def test_it_is_told_the_delay_and_needs_it():
    force = pushed(STEPS, delay=8)
    assert error(believe(force, delay=0.4)) < 0.6 * error(believe(force))


def test_strength_is_confounded_with_stubbornness_unless_it_is_told():
    frail = pushed(np.full(T.size, 0.6), force_max=5.0)
    assert error(believe(frail, **SPREAD), 0.6) > 2.0 * error(
        believe(frail, gain=(2.0, 2.5), force_max=(5.0, 4.0)), 0.6
    )


def test_in_saturation_it_learns_a_lower_bound_alone():
    beliefs = believe(pushed(np.full(T.size, 0.9), np.ones(T.size)), np.ones(T.size), walk=0.01)
    low = beliefs[-1, GRID < 0.35].sum()
    assert low < 0.05
    # Above it, what was believed before: all values are as likely.
    above = beliefs[-1, GRID > 0.7]
    assert above.max() < 1.5 * above.min()


def test_where_nobody_disagrees_it_says_the_prior():
    prior = np.exp(-0.5 * ((GRID - 0.3) / 0.1) ** 2)
    nothing = np.zeros(T.size)
    beliefs = believe(pushed(STEPS, nothing), nothing, prior, walk=0.0, noise=1.0)
    assert beliefs[-1] == pytest.approx(0.99 * prior / prior.sum() + 0.01 / GRID.size, abs=1e-9)


def test_it_forgets_what_it_has_not_heard_for_long():
    force = pushed(np.full(T.size, 0.8))
    force[T > 10.0] = np.nan
    mean, deviation = grid_moments(believe(force))
    heard, silent = T.searchsorted(10.0), -1
    assert mean[heard] == pytest.approx(0.8, abs=0.1)
    assert abs(mean[silent] - 0.5) < abs(mean[heard] - 0.5)
    assert deviation[silent] > 2.0 * deviation[heard]


@pytest.mark.parametrize("end", [0.0, 1.0])
def test_nothing_leaks_over_the_ends(end):
    apart = np.full(T.size, 0.3)
    beliefs = believe(pushed(np.full(T.size, end), apart), apart, walk=0.2, renewal=0.0)
    assert beliefs[-1, np.abs(GRID - end) > 0.5].sum() < 1e-6


def test_it_survives_a_force_that_nothing_explains():
    assert np.isfinite(believe(np.full(T.size, 1e4))).all()


@pytest.mark.parametrize(
    "wrong",
    [
        {"noise": 0.0},
        {"period": -1.0},
        {"delay": -0.1},
        {"walk": np.nan},
        {"renewal": -1.0},
        {"prior": np.zeros(GRID.size)},
        {"prior": np.ones(3)},
        {"gain": (1.0,)},
    ],
    ids=lambda wrong: next(iter(wrong)),
)
def test_nonsense_is_refused(wrong):
    with pytest.raises(InputError, match=next(iter(wrong))):
        believe(pushed(STEPS), **wrong)
