"""Wheel speeds from twists, limits that keep the curve, and the delayed command."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from cowalk.sim.basics.errors import InputError
from cowalk.sim.robot.drive import Command, DriveParameters
from cowalk.sim.robot.wheels import limited, wheel_speeds

speeds, rates = st.floats(-5.0, 5.0), st.floats(-10.0, 10.0)
LIMITS = (1.5, 1.5, 0.42, 2.0)


def test_turning_on_the_spot_and_straight_ahead():
    np.testing.assert_allclose(
        wheel_speeds(np.array([1.0, 0.0]), np.array([0.0, 2.0]), 0.4, 0.1),
        [[10.0, -4.0], [10.0, 4.0]],
    )


@given(speeds, rates, st.floats(0.1, 1.0), st.floats(0.02, 0.3))
def test_wheel_speeds_and_back(v, omega, track, radius):
    left, right = wheel_speeds(v, omega, track, radius)
    assert (left + right) * radius / 2.0 == pytest.approx(v, abs=1e-9)
    assert (right - left) * radius / track == pytest.approx(omega, abs=1e-9)


@given(speeds, rates)
def test_limits_hold_and_keep_the_curve(v, omega):
    slow_v, slow_omega = limited((v, omega), *LIMITS)
    assert abs(slow_v) <= 1.5 + 1e-12
    assert abs(slow_omega) <= 1.5 + 1e-12
    rim = wheel_speeds(slow_v, slow_omega, 0.42, 1.0)
    assert np.abs(rim).max() <= 2.0 + 1e-12
    assert slow_v * omega == pytest.approx(slow_omega * v)
    assert slow_v * v >= 0.0
    # No slower than it has to be: one limit is met, or nothing was changed.
    met = max(abs(slow_v) / 1.5, abs(slow_omega) / 1.5, np.abs(rim).max() / 2.0)
    assert (slow_v, slow_omega) == (v, omega) or met == pytest.approx(1.0)


@given(st.floats(0.2, 2.0))
def test_the_command_is_approached_by_the_allowed_slope(wanted):
    assume(abs(wanted - 1.5) > 0.01)
    command = Command(DriveParameters(), 1.0 / 240.0)
    command.set(wanted, 0.0)
    reached = np.array([command.advance()[0] for _ in range(240 * 5)])
    assert np.diff(reached).max() == pytest.approx(0.5 / 240.0)
    assert reached[-1] == pytest.approx(min(wanted, 1.5))


def test_a_delayed_command_is_the_same_later():
    def course(delay):
        command = Command(DriveParameters(delay=delay), 1.0 / 240.0)
        taken = []
        for step in range(200):
            command.set(math.sin(0.02 * step), 0.3)
            taken.append(command.advance())
        return taken

    at_once, late = course(0.0), course(0.1)
    assert late[:24] == [(0.0, 0.0)] * 24
    assert late[24:] == at_once[:-24]


@pytest.mark.parametrize(
    ("given", "named"),
    [({"kind": "legs"}, "kind = 'legs'.*slip, wheels"), ({"max_speed": 0.0}, "max_speed = 0.0")],
)
def test_no_such_drive(given, named):
    with pytest.raises(InputError, match=named):
        DriveParameters(**given)
