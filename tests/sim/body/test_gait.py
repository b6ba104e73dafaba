"""Cadence and sway of the trunk, from their sources and as a function of time."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim.basics.errors import InputError
from cowalk.sim.body.gait import (
    LATERAL,
    SPREAD,
    VERTICAL,
    Gait,
    GaitParameters,
    fore_aft,
    lateral,
    step_frequency,
)

STEP = 1.0 / 240.0


def settled(speed, seconds=8.0, **parameters):
    gait = Gait(GaitParameters(enabled=True, **parameters), STEP)
    gait.reset(np.random.default_rng(0))
    for _ in range(round(5.0 / STEP)):
        gait.update(speed)
    return np.array([gait.update(speed) for _ in range(round(seconds / STEP))])


def test_cadence_is_the_usual_one_at_the_preferred_speed():
    assert step_frequency(1.3) == pytest.approx(1.82)


@given(st.floats(0.3, 2.0))
def test_step_length_grows_with_speed_to_the_0_42(speed):
    lengths = [v / step_frequency(v) for v in (speed, 1.3)]
    assert math.log(lengths[0] / lengths[1]) == pytest.approx(0.42 * math.log(speed / 1.3))


def test_cadence_agrees_with_grieve_and_gear():
    """64.8 (v / stature)^0.57 strides a minute for men (1966), two steps a stride."""
    for speed in (0.6, 0.8, 1.0, 1.3, 1.6):
        expected = 2.0 * 64.8 * (speed / 1.75) ** 0.57 / 60.0
        assert step_frequency(speed) == pytest.approx(expected, rel=0.02)


def test_side_to_side_is_as_measured_and_narrower_the_faster():
    assert [lateral(v) for v in (0.7, 1.6)] == pytest.approx(LATERAL)
    assert lateral(1.15) == pytest.approx(sum(LATERAL) / 2.0)
    assert lateral(0.4) == lateral(0.7)
    assert lateral(2.5) == lateral(1.6)


@pytest.mark.parametrize(("speed", "vertical"), [(0.7, VERTICAL[0]), (1.6, VERTICAL[1])])
def test_fore_and_aft_as_much_energy_comes_and_goes_as_up_and_down(speed, vertical):
    """A pendulum of a kilogram: v dv = g A_z, where dv = 2 pi f A peak to peak."""
    apart = math.tau * step_frequency(speed) * fore_aft(speed)
    assert speed * apart == pytest.approx(9.81 * vertical)
    assert apart < 0.4, "m/s; the sizes before, of unknown source, made 0.75"


def test_the_centre_of_mass_walks_a_figure_of_eight_of_about_the_published_length():
    """18 cm in three dimensions (Tesio and Rota 2019), of which two are ours."""
    phase = np.linspace(0.0, math.tau, 2001)
    height = VERTICAL[0] + (1.3 - 0.7) / 0.9 * (VERTICAL[1] - VERTICAL[0])

    def length(ahead, aside):
        way = ahead * np.sin(2 * phase), aside * np.sin(phase), height * np.cos(2 * phase)
        return np.hypot(np.hypot(*np.diff(way[:2]) / 2.0), np.diff(way[2]) / 2.0).sum()

    assert length(*GaitParameters().sway) == pytest.approx(0.24, abs=0.005)
    assert length(0.0, lateral(1.3)) == pytest.approx(0.20, abs=0.005)
    assert length(0.066, 0.060) > 0.36, "what it was"


@pytest.mark.parametrize(("percentile", "deviations"), [(5.0, -1.645), (50.0, 0.0), (95.0, 1.645)])
@pytest.mark.parametrize("speed", [0.8, 1.3])
def test_people_differ_as_published(percentile, deviations, speed):
    expected = np.array([fore_aft(speed), lateral(speed)]) * math.exp(deviations * SPREAD)
    given = GaitParameters(percentile=percentile)
    assert given.sway_at(speed) == pytest.approx(expected, rel=1e-3)
    sway = settled(speed, percentile=percentile)
    assert np.ptp(sway[:, :2], axis=0) == pytest.approx(expected, rel=2e-3)


def test_sizes_of_ones_own_are_those_at_the_preferred_speed_and_go_with_it():
    own = GaitParameters(fore_aft=0.05, lateral=0.10)
    assert own.sway == own.sway_at(1.3) == (0.05, 0.10)
    assert own.sway_at(0.8)[1] == pytest.approx(0.10 * lateral(0.8) / lateral(1.3))
    assert GaitParameters(fore_aft=0.0, lateral=0.0).sway_at(0.8) == (0.0, 0.0)


@given(st.floats(5.0, 95.0), st.floats(5.0, 95.0))
def test_sway_grows_with_the_percentile(one, other):
    small, large = (GaitParameters(percentile=p).sway for p in sorted((one, other)))
    assert all(a <= b for a, b in zip(small, large, strict=True))


@given(st.floats(0.0, 3.0))
def test_sway_has_no_jump_in_speed(speed):
    here, beyond = (GaitParameters().sway_at(v) for v in (speed, speed + 1e-6))
    assert here == pytest.approx(beyond, abs=1e-6)


def test_velocity_and_acceleration_are_derivatives():
    sway = settled(1.0)
    np.testing.assert_allclose(
        sway[1:-1, 2:4], (sway[2:, :2] - sway[:-2, :2]) / (2 * STEP), atol=2e-3
    )
    # The acceleration is of half a step ahead.
    np.testing.assert_allclose(sway[:-1, 4:6], np.diff(sway[:, 2:4], axis=0) / STEP, atol=5e-3)


@pytest.mark.parametrize("speed", [0.4, 0.8, 1.2])
def test_fore_aft_once_a_step_lateral_once_a_stride(speed):
    sway = settled(speed, seconds=20.0)
    for axis, expected in ((0, step_frequency(speed)), (1, step_frequency(speed) / 2.0)):
        crossings = np.sum((sway[:-1, axis] < 0.0) & (sway[1:, axis] >= 0.0))
        assert crossings == pytest.approx(20.0 * expected, abs=1.0)


def test_standing_still_is_still():
    assert np.abs(settled(0.0)).max() == 0.0


def test_the_phase_is_the_seeds():
    def start(seed):
        gait = Gait(GaitParameters(enabled=True), STEP)
        gait.reset(np.random.default_rng(seed))
        return gait.phase

    assert start(1) == start(1)
    assert start(1) != start(2)


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"percentile": 99.0}, "percentile = 99.0"),
        ({"fore_aft": -0.1}, "fore_aft = -0.1 m"),
        ({"step_frequency": 0.0}, "step_frequency = 0.0 Hz"),
    ],
)
def test_no_such_gait(given, named):
    with pytest.raises(InputError, match=named):
        GaitParameters(**given)
