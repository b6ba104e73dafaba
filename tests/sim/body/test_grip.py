"""The yielding grip alone, and the frame in which its wrench is reported."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.frames import rotation
from cowalk.sim.body.grip import Bushing, GripParameters
from cowalk.sim.sensor.wrench import SensorMount, in_base_frame, in_sensor_frame

small = st.floats(-0.02, 0.02)
angles = st.floats(-3.0, 3.0)
STILL = (0.0, 0.0, 0.0)


@given(small, small, small)
def test_spring_and_damper_in_every_axis(x, y, z):
    bushing = Bushing(
        GripParameters(kind="compliant", stiffness=(100.0, 200.0, 300.0), damping=(1.0, 2.0, 3.0))
    )
    force = bushing.force((x, y, z), (z, x, y))
    assert force == pytest.approx((100 * x + z, 200 * y + 2 * x, 300 * z + 3 * y))


@given(st.floats(0.0, 0.05), angles)
def test_it_slips_at_the_set_force_and_keeps_where_it_slid(far, angle):
    bushing = Bushing(GripParameters(kind="compliant", slip_force=20.0))
    pulled = (far * math.cos(angle), far * math.sin(angle), 0.0)
    first = math.hypot(*bushing.force(pulled, STILL)[:2])
    assert first == pytest.approx(min(4000.0 * far, 20.0))
    assert math.hypot(*bushing.force(pulled, STILL)[:2]) == pytest.approx(first)
    # Back at the start it pushes the other way by as much as it has slid, at most 20 N.
    back = math.hypot(*bushing.force(STILL, STILL)[:2])
    assert back == pytest.approx(min(4000.0 * max(0.0, far - 0.005), 20.0), abs=1e-9)


def test_it_is_lost_once_it_slid_too_far():
    bushing = Bushing(GripParameters(kind="compliant", slip_force=20.0, slip_length=0.03))
    bushing.force((0.034, 0.0, 0.0), STILL)
    assert not bushing.lost
    bushing.force((0.036, 0.0, 0.0), STILL)
    assert bushing.lost


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"kind": "glue"}, "kind = 'glue'.*rigid, compliant"),
        ({"on_loss": "cry"}, "on_loss = 'cry'.*end, stop"),
        ({"slip_force": 5.0}, "only a compliant grip can slip"),
        ({"kind": "compliant", "stiffness": (0.0, 1.0, 1.0)}, "stiffness"),
        ({"release_force": -1.0}, "release_force = -1.0"),
    ],
)
def test_no_such_grip(given, named):
    with pytest.raises(InputError, match=named):
        GripParameters(**given)


def test_a_raised_and_turned_sensor():
    mount = SensorMount(position=(0.0, 0.0, -0.1), rpy=(0.0, 0.0, math.pi / 2))
    seen = in_sensor_frame(np.array([5.0, 0.0, 0.0, 0.0, 0.0, 0.0]), mount)
    # 5 N forwards, 0.1 m above the sensor, tips it by 0.5 N m about the base's y; its own x is y.
    np.testing.assert_allclose(seen, [0.0, -5.0, 0.0, 0.5, 0.0, 0.0], atol=1e-12)


@given(st.tuples(angles, angles, angles), st.tuples(small, small, small))
def test_power_does_not_depend_on_the_frame(rpy, position):
    rng = np.random.default_rng(0)
    wrench, velocity, rate = rng.normal(size=(4, 6)), rng.normal(size=3), rng.normal(size=3)
    mount = SensorMount(position, rpy)
    seen = in_sensor_frame(wrench, mount)
    turn = in_sensor_frame(np.eye(6), SensorMount(rpy=rpy))[:3, :3].T
    there = turn @ (velocity + np.cross(rate, position))
    power = wrench[:, :3] @ velocity + wrench[:, 3:] @ rate
    np.testing.assert_allclose(seen[:, :3] @ there + seen[:, 3:] @ (turn @ rate), power, atol=1e-9)


@given(st.tuples(angles, angles, angles), st.tuples(small, small, small))
def test_the_way_back_is_the_inverse(rpy, position):
    wrench, mount = np.random.default_rng(0).normal(size=(2, 3, 6)), SensorMount(position, rpy)
    seen = in_sensor_frame(wrench, mount)
    np.testing.assert_allclose(in_base_frame(seen, mount), wrench, atol=1e-9)
    np.testing.assert_allclose(
        in_sensor_frame(in_base_frame(wrench, mount), mount), wrench, atol=1e-9
    )
    for one, frame in ((wrench[0, 0], seen[0, 0]), (wrench[:1, 1], seen[:1, 1])):
        np.testing.assert_allclose(in_sensor_frame(one, mount), frame, atol=1e-9)


@given(st.tuples(angles, angles, angles), st.tuples(small, small, small))
def test_forces_turn_with_the_frame_and_torques_move_with_its_origin(rpy, position):
    mount, rng = SensorMount(position, rpy), np.random.default_rng(1)
    force, torque = rng.normal(size=(2, 3))
    seen = in_sensor_frame(np.concatenate((force, torque)), mount)
    turn = rotation(*rpy)
    np.testing.assert_allclose(turn @ seen[:3], force, atol=1e-9)
    np.testing.assert_allclose(turn @ seen[3:], torque - np.cross(position, force), atol=1e-9)


def test_at_the_handle_nothing_changes():
    wrench = np.random.default_rng(0).normal(size=(4, 6))
    assert in_sensor_frame(wrench, SensorMount()) is wrench
    assert in_base_frame(wrench, SensorMount()) is wrench
