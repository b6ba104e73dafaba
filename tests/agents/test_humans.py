"""What each human model is for: one behaviour, or one published number, a test."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cowalk.agents.humans.escalating import EscalatingHuman
from cowalk.agents.humans.intention import Intention, IntentionSettings
from cowalk.agents.humans.open_loop import OpenLoopHuman
from cowalk.agents.humans.steady import SteadyHuman
from cowalk.sim.errors import InputError
from cowalk.sim.motion import arc_displacement, compose

NO_RNG = np.random.default_rng(0)


def test_open_loop_forces_change_when_they_should(situation, observe):
    human = OpenLoopHuman(profile=((12.0, 0.0, 3.0), (19.0, -1.0, 4.0)))
    human.reset(NO_RNG, situation)
    # 240 periods of 0.05 s are a little less than 12 s in floating point.
    times = {11.95: (0.0, 0.0), float(np.sum([0.05] * 240)): (0.0, 3.0), 19.0: (-1.0, 4.0)}
    for time, force in times.items():
        np.testing.assert_array_equal(human.act(observe(time=time)), force)


def test_stubbornness_zero_lets_go_and_one_insists_fully(situation, observe):
    turning = observe(twist=(0.8, 0.25))
    forces = []
    for level in (0.0, 0.5, 1.0):
        human = SteadyHuman(level=(level, level), gain=2.0)
        human.reset(NO_RNG, situation)
        forces.append(human.act(turning)[1])
    # gain * s * (0 - 0.25)/0.5 of 7.5 N
    np.testing.assert_allclose(forces, [0.0, -3.75, -7.5])


def test_stubbornness_escalates_by_the_published_share_a_turn(situation, observe):
    human = EscalatingHuman(initial=(0.1, 0.1), growth=0.38, turn=2.0)
    human.reset(NO_RNG, situation)
    against = observe(twist=(0.8, 0.5))
    turns = []
    for k in range(161):
        human.act(against)
        if k % 40 == 0:
            turns.append(human.truth().stubbornness[1])
    np.testing.assert_allclose(np.divide(turns[1:], turns[:-1]), 1.38, rtol=1e-9)


def test_escalation_relaxes_when_met_and_holds_if_told_to(situation, observe):
    against, met = observe(twist=(0.8, 0.5)), observe(twist=(0.8, 0.0))
    levels = {}
    for hold in (0.0, 100.0):
        human = EscalatingHuman(initial=(0.3, 0.3), relaxation=2.0, hold=hold)
        human.reset(NO_RNG, situation)
        for _ in range(60):
            human.act(against)
        before = human.truth().stubbornness[1]
        for _ in range(40):
            human.act(met)
        levels[hold] = before, human.truth().stubbornness[1]
    before, after = levels[0.0]
    assert after - 0.3 == pytest.approx((before - 0.3) * np.exp(-1.0), rel=1e-6)
    assert levels[100.0][1] == levels[100.0][0] == before


def test_growth_zero_is_a_steady_human(situation, observe):
    human = EscalatingHuman(initial=(0.4, 0.4), growth=0.0)
    human.reset(NO_RNG, situation)
    for _ in range(50):
        human.act(observe(twist=(0.3, 0.4)))
        np.testing.assert_allclose(human.truth().stubbornness, 0.4)


@pytest.mark.parametrize(
    ("build", "named"),
    [
        (lambda: SteadyHuman(level=(0.5, 1.5)), r"level = .*1\.5"),
        (lambda: EscalatingHuman(turn=0.0), r"turn = 0\.0"),
        (lambda: EscalatingHuman(growth=-1.0), r"growth = -1\.0"),
        (lambda: SteadyHuman(gain=0.0), r"gain = 0\.0"),
        (lambda: SteadyHuman(force_max=(0.0, 1.0)), "force_max"),
        (lambda: OpenLoopHuman(profile=((2.0, 0.0, 0.0), (1.0, 0.0, 0.0))), "profile"),
    ],
)
def test_impossible_parameters_are_named(build, named):
    with pytest.raises(InputError, match=named):
        build()


def walk_alone(situation, settings, obstacles_world=(), start=(0.0, 0.0, 0.0), steps=500):
    """Let the intention alone steer a unicycle; return its path."""
    intention = Intention(settings, situation)
    pose, path = np.array(start), []
    for _ in range(steps):
        rows = np.zeros((8, 4))
        for i, (x, y, radius) in enumerate(obstacles_world):
            cos, sin = np.cos(pose[2]), np.sin(pose[2])
            dx, dy = x - pose[0], y - pose[1]
            rows[i] = [1.0, cos * dx + sin * dy, cos * dy - sin * dx, radius]
        twist = intention.wish({"pose": pose, "obstacles": rows, "twist": np.zeros(2)})
        pose = compose(pose, arc_displacement(twist, situation.period))
        path.append(pose)
    return np.array(path)


@given(st.floats(-1.0, 1.0), st.floats(-0.8, 0.8))
def test_an_intention_alone_returns_to_the_path(offset, heading):
    from cowalk.agents.interfaces import Situation
    from cowalk.sim.motion import Path, TwistBounds

    straight = Situation(Path(((0.0, 0.0), (30.0, 0.0))), 0.8, TwistBounds(), 0.05)
    path = walk_alone(straight, IntentionSettings(), start=(0.0, offset, heading))
    assert np.abs(path[-100:, 1]).max() < 0.02


@pytest.mark.parametrize("y", [-0.75, -0.2, 0.2, 0.5])
def test_an_intention_alone_clears_what_it_sees_by_its_margin(situation, y):
    settings = IntentionSettings(margin=0.2, anticipation=6.0)
    path = walk_alone(situation, settings, obstacles_world=((9.0, y, 0.35),))
    left, right = settings.extent
    beside = np.abs(path[:, 0] - 9.0) < 0.35
    gap_left = y - 0.35 - (path[beside, 1] + left)
    gap_right = (path[beside, 1] - right) - (y + 0.35)
    assert max(gap_left.min(), gap_right.min()) > 0.8 * settings.margin


def test_what_is_not_in_the_way_is_left_alone(situation):
    path = walk_alone(situation, IntentionSettings(), obstacles_world=((9.0, 2.0, 0.3),))
    assert np.abs(path[:, 1]).max() < 1e-9
