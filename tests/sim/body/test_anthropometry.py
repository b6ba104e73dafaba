"""Segment masses and lengths, and an arm of any size on a handle at any height."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim.basics.errors import InputError
from cowalk.sim.body.anthropometry import (
    HEAD_MASS,
    TRUNK_MASS,
    WINTER,
    BodyParameters,
    forearm_with_hand,
    segment,
    yaw_inertia,
)
from cowalk.sim.body.arm import ELBOW_FREE, SHOULDER_FREE, arm_of, links
from cowalk.sim.body.human_body import human_body

bodies = st.builds(BodyParameters, st.floats(1.5, 2.0), st.floats(40.0, 120.0))


def test_segments_make_up_the_body():
    assert 2 * sum(s.mass for s in WINTER.values()) + HEAD_MASS + TRUNK_MASS == pytest.approx(1.0)


def test_numbers_of_the_table():
    body = BodyParameters(1.75, 70.0)
    assert segment(body, "upper_arm").mass == pytest.approx(1.96)
    assert segment(body, "thigh").length == pytest.approx(0.245 * 1.75)
    # Winter's own row "forearm and hand": 2.2 % of the mass, centre at 68.2 % of elbow to wrist.
    # (His rows are measured one by one and agree among themselves within 4 %.)
    fore = forearm_with_hand(body)
    assert fore.mass == pytest.approx(1.54)
    assert fore.centre == pytest.approx(0.682 * 0.146 * 1.75, rel=0.04)
    # ... and radius of gyration 0.827 of it about the elbow.
    about_elbow = fore.inertia + fore.mass * fore.centre**2
    assert (about_elbow / fore.mass) ** 0.5 == pytest.approx(0.827 * 0.146 * 1.75, rel=0.04)
    assert yaw_inertia(body) == pytest.approx(1.2, rel=0.01)


@given(bodies, st.floats(0.5, 2.0))
def test_inertia_scales_with_mass_and_the_square_of_height(body, scale):
    if not 20.0 <= body.mass * scale <= 200.0:
        return
    heavier = BodyParameters(body.height, body.mass * scale)
    lower = BodyParameters(1.25, body.mass)
    for name in WINTER:
        own = segment(body, name)
        assert segment(heavier, name).inertia == pytest.approx(scale * own.inertia)
        assert segment(lower, name).inertia == pytest.approx(
            own.inertia * (1.25 / body.height) ** 2
        )


@given(bodies, st.floats(0.95, 1.15))
def test_the_grip_is_at_the_handles_height(body, height):
    upper, fore = links(body, height)
    assert 0.818 * body.height - upper.drop - fore.drop == pytest.approx(height)
    for part, whole in ((upper, segment(body, "upper_arm")), (fore, forearm_with_hand(body))):
        assert np.hypot(part.length, part.drop) == pytest.approx(whole.length)


@pytest.mark.parametrize("side", ["left", "right"])
@given(
    elbow=st.floats(ELBOW_FREE[0] + 0.05, ELBOW_FREE[1] - 0.05),
    shoulder=st.floats(SHOULDER_FREE[0] + 0.05, SHOULDER_FREE[1] - 0.05),
)
def test_angles_put_the_hand_there(side, shoulder, elbow):
    arm = arm_of(BodyParameters(), side, 1.04)
    shoulder, elbow = arm.side * shoulder, arm.side * elbow
    along = np.array([np.cos(shoulder), np.sin(shoulder)])
    beyond = np.array([np.cos(shoulder + elbow), np.sin(shoulder + elbow)])
    hand = arm.shoulder + arm.upper.length * along + arm.fore.length * beyond
    assert arm.angles(tuple(hand)) == pytest.approx((shoulder, elbow), abs=1e-6)
    step = 1e-6
    moved = arm.fore.length * np.array(
        [np.cos(shoulder + elbow + step), np.sin(shoulder + elbow + step)]
    )
    np.testing.assert_allclose(
        arm.jacobian(shoulder, elbow)[:, 1],
        (moved - arm.fore.length * beyond) / step,
        atol=1e-5,
    )


def test_a_right_handed_human_is_the_mirror_image():
    left = human_body(BodyParameters(hand="left"), ((0.15, -0.30, 1.04),))
    right = human_body(BodyParameters(hand="right"), ((0.15, 0.30, 1.04),))
    assert right.place == pytest.approx((left.place[0], -left.place[1], 0.0))
    np.testing.assert_allclose(right.posture, -np.array(left.posture))


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"height": 3.0}, "height = 3.0 m"),
        ({"mass": -1.0}, "mass = -1.0 kg"),
        ({"hand": "foot"}, "hand = 'foot': must be one of left, right, both"),
    ],
)
def test_no_such_body(given, named):
    with pytest.raises(InputError, match=named):
        BodyParameters(**given)


def test_a_handle_out_of_reach_is_named():
    with pytest.raises(InputError, match=r"cannot hold a handle at 0\.20 m"):
        human_body(BodyParameters(), ((0.15, -0.30, 0.2),))


@pytest.mark.parametrize("hand", ["left", "right", "both"])
@given(st.floats(1.4, 2.0))
def test_people_of_any_size_hold_on_far_from_their_joints_limits(hand, height):
    handles = ((-0.3, 0.22, 1.0), (-0.3, -0.22, 1.0))
    body = human_body(BodyParameters(height, hand=hand), handles if hand == "both" else handles[:1])
    shoulders, elbows = np.abs(body.posture[::2]), np.abs(body.posture[1::2])
    assert ((elbows > 1.7) & (elbows < 2.2)).all()
    assert (shoulders < SHOULDER_FREE[1] - 0.4).all()
