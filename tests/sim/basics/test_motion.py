import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from cowalk.sim.basics.motion import (
    TwistBounds,
    arc_displacement,
    compose,
    world_to_base,
    wrap_angle,
)

finite = st.floats(-3.0, 3.0)
twists = arrays(float, 2, elements=finite)
poses = arrays(float, 3, elements=finite)


@given(twists, st.floats(0.0, 3.0))
def test_arc_agrees_with_integrated_unicycle(twist, duration):
    steps = 2000
    times = (np.arange(steps) + 0.5) * duration / steps
    heading = twist[1] * times
    expected = [
        np.mean(twist[0] * np.cos(heading)) * duration,
        np.mean(twist[0] * np.sin(heading)) * duration,
        twist[1] * duration,
    ]
    np.testing.assert_allclose(arc_displacement(twist, duration), expected, atol=1e-4)


@pytest.mark.parametrize("omega", [0.0, 1e-300, 1e-12, 1e-8, -1e-8])
def test_arc_is_straight_where_turn_vanishes(omega):
    np.testing.assert_allclose(arc_displacement([0.8, omega], 2.0)[:2], [1.6, 0.0], atol=2e-8)


@given(twists, poses, st.floats(0.0, 2.0), st.floats(0.0, 2.0))
def test_arcs_of_one_twist_compose(twist, pose, first, second):
    halfway = compose(pose, arc_displacement(twist, first))
    both = compose(halfway, arc_displacement(twist, second))
    at_once = compose(pose, arc_displacement(twist, first + second))
    np.testing.assert_allclose(both, at_once, atol=1e-9)


@given(poses, arrays(float, (4, 2), elements=finite))
def test_world_to_base_inverts_compose(pose, points):
    displacement = np.concatenate((points, np.zeros((4, 1))), axis=1)
    np.testing.assert_allclose(
        world_to_base(pose, compose(pose, displacement)[:, :2]), points, atol=1e-9
    )


def test_arrays_broadcast_over_leading_axes():
    batch = np.random.default_rng(0).normal(size=(5, 7, 2))
    together = arc_displacement(batch, 1.5)
    assert together.shape == (5, 7, 3)
    np.testing.assert_array_equal(together[3, 4], arc_displacement(batch[3, 4], 1.5))


@given(st.floats(-50.0, 50.0))
def test_wrapped_angle_is_the_same_direction(angle):
    wrapped = wrap_angle(angle)
    assert -np.pi <= wrapped < np.pi
    assert np.cos(wrapped) == pytest.approx(np.cos(angle), abs=1e-9)
    assert np.sin(wrapped) == pytest.approx(np.sin(angle), abs=1e-9)


def test_bounds_must_be_ordered():
    with pytest.raises(ValueError, match="omega"):
        TwistBounds(lower=(0.0, 0.5), upper=(1.0, 0.5))
