"""Where a human wants to go: alone, past what they see, along a path of their own, otherwise."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cowalk.agents.humans.intention.intention import ChangeOfMind, Intention, IntentionSettings
from cowalk.agents.humans.steady import SteadyHuman
from cowalk.scenarios.files.loading import load
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import TwistBounds, arc_displacement, compose
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.situation import Situation

CORRIDOR = Situation(
    Path(((0.0, 0.0), (30.0, 0.0))), 0.8, TwistBounds((0.0, -0.5), (1.2, 0.5)), 0.05
)
SIDE_CORRIDOR = Path(((0.0, 0.0), (8.0, 0.0), (8.0, 20.0)))


def walk_alone(wanted, obstacles_world=(), start=(0.0, 0.0, 0.0), steps=500, situation=CORRIDOR):
    """Let the intention alone steer a unicycle; return its poses and twists.

    ``obstacles_world`` holds (x, y, radius), or is a function of time that returns them.
    """
    where = obstacles_world if callable(obstacles_world) else lambda _: obstacles_world
    intention = Intention(wanted, situation)
    pose, poses, twists = np.array(start), [], []
    for k in range(steps):
        rows = np.zeros((8, 4))
        for i, (x, y, radius) in enumerate(where(k * situation.period)):
            cos, sin = np.cos(pose[2]), np.sin(pose[2])
            dx, dy = x - pose[0], y - pose[1]
            rows[i] = [1.0, cos * dx + sin * dy, cos * dy - sin * dx, radius]
        seen = {
            "pose": np.array(situation.path.relative(*pose)),
            "pose_world": pose,
            "obstacles": rows,
            "time": np.array([k * situation.period]),
        }
        twist = intention.wish(seen)
        pose = compose(pose, arc_displacement(twist, situation.period))
        poses.append(pose)
        twists.append(twist)
    return np.array(poses), np.array(twists)


@settings(max_examples=25, deadline=None)
@given(st.floats(-1.0, 1.0), st.floats(-0.8, 0.8))
def test_an_intention_alone_returns_to_the_path(offset, heading):
    poses, _ = walk_alone(IntentionSettings(), start=(0.0, offset, heading))
    assert np.abs(poses[-100:, 1]).max() < 0.02


@pytest.mark.parametrize("y", [-0.75, -0.2, 0.2, 0.5])
def test_an_intention_alone_clears_what_it_sees_by_its_margin(y):
    settings = IntentionSettings(margin=0.2, anticipation=6.0)
    poses, _ = walk_alone(settings, obstacles_world=((9.0, y, 0.35),))
    left, right, _ = CORRIDOR.extent
    beside = np.abs(poses[:, 0] - 9.0) < 0.35
    gap_left = y - 0.35 - (poses[beside, 1] + left)
    gap_right = (poses[beside, 1] - right) - (y + 0.35)
    assert max(gap_left.min(), gap_right.min()) > 0.8 * settings.margin


def largest_change(wanted, length):
    """Bound how much the wish for omega may change in a control step, rad/s.

    omega = 2 v sin(alpha)/lookahead; the aim moves by a length with minimum jerk, at most by
    15/8 of it an easing, and the base's own motion moves it by less than three times the way.
    """
    way = wanted.pace * CORRIDOR.period
    return 2.0 * wanted.pace / wanted.lookahead**2 * (15.0 / 8.0 * length / wanted.easing + 3) * way


def test_a_slow_walk_past_an_obstacle_bends_the_wish_and_never_makes_it_jump():
    wanted = IntentionSettings(pace=0.3)
    _, twists = walk_alone(wanted, ((6.0, -0.75, 0.35),), steps=800)
    detour = -0.75 + 0.35 + wanted.margin + CORRIDOR.extent[1]
    assert twists[:, 1].max() > 0.08  # they do turn, out and back
    assert twists[:, 1].min() < -0.08
    assert np.abs(np.diff(twists[:, 1])).max() < largest_change(wanted, detour)


def test_a_change_of_side_bends_the_wish_too():
    wanted = IntentionSettings(pace=0.3)
    poses, twists = walk_alone(wanted, lambda time: ((5.0, 1.5 - 0.2 * time, 0.3),), steps=400)
    assert poses[:, 1].min() < -0.15  # first to the right of who comes from the left
    assert poses[:, 1].max() > 0.09
    from_side_to_side = 2 * (0.3 + wanted.margin) + sum(CORRIDOR.extent[:2])
    assert np.abs(np.diff(twists[:, 1])).max() < largest_change(wanted, from_side_to_side)


def test_what_is_not_in_the_way_is_left_alone():
    poses, _ = walk_alone(IntentionSettings(), obstacles_world=((9.0, 2.0, 0.3),))
    assert np.abs(poses[:, 1]).max() < 1e-9


def test_of_two_obstacles_the_nearer_one_is_walked_around_first():
    both, _ = walk_alone(IntentionSettings(), ((9.0, 0.5, 0.2), (6.0, -0.75, 0.2)), steps=140)
    nearer, _ = walk_alone(IntentionSettings(), ((6.0, -0.75, 0.2),), steps=140)
    np.testing.assert_allclose(both, nearer)


def test_a_path_of_their_own_is_followed_into_a_side_corridor():
    poses, _ = walk_alone(IntentionSettings(path=SIDE_CORRIDOR), steps=600)
    np.testing.assert_allclose(poses[-100:, 0], 8.0, atol=0.02)
    np.testing.assert_allclose(poses[-1, 2], np.pi / 2.0, atol=0.02)
    assert np.abs(poses[:, 0]).max() < 8.5  # cuts the corner rather than missing it


def test_a_path_of_their_own_is_the_same_seen_from_any_path_of_the_scenario():
    bent = Situation(Path(((0.0, 1.0), (5.0, -1.0), (20.0, 3.0))), 0.8, CORRIDOR.bounds, 0.05)
    straight, _ = walk_alone(IntentionSettings(path=SIDE_CORRIDOR), steps=300)
    seen_from_bent, _ = walk_alone(IntentionSettings(path=SIDE_CORRIDOR), steps=300, situation=bent)
    np.testing.assert_allclose(seen_from_bent, straight, atol=1e-6)


def test_changes_of_mind_come_at_their_time_or_place_and_stay():
    slow_then_stop = (ChangeOfMind(at_station=4.0, pace=0.3), ChangeOfMind(at_time=10.0, pace=0.0))
    poses, twists = walk_alone(IntentionSettings(changes=slow_then_stop), steps=300)
    where = np.concatenate(([0.0], poses[:-1, 0]))
    np.testing.assert_allclose(twists[where < 4.0, 0], 0.8)
    walking = (where >= 4.0) & (np.arange(300) < 200)
    assert walking.any()
    np.testing.assert_allclose(twists[walking, 0], 0.3)
    np.testing.assert_array_equal(twists[200:], 0.0)  # who stops does not turn either


def test_of_two_changes_the_one_that_came_last_holds():
    changes = (ChangeOfMind(at_time=8.0, pace=0.5), ChangeOfMind(at_station=2.0, pace=1.0))
    _, twists = walk_alone(IntentionSettings(changes=changes), steps=200)
    np.testing.assert_allclose(twists[[0, 100, 180], 0], [0.8, 1.0, 0.5])


def test_a_turn_off_at_a_place():
    settings = IntentionSettings(changes=(ChangeOfMind(at_station=4.0, path=SIDE_CORRIDOR),))
    poses, _ = walk_alone(settings, steps=600)
    np.testing.assert_allclose(poses[-50:, 0], 8.0, atol=0.02)


def test_a_batch_changes_its_mind_one_by_one():
    settings = IntentionSettings(
        pace=0.7,
        changes=(
            ChangeOfMind(at_station=2.0, path=SIDE_CORRIDOR),
            ChangeOfMind(at_time=4.0, pace=0.4),
        ),
    )
    rng = np.random.default_rng(0)
    lanes = rng.uniform([-4.0, -0.5, -0.3], [0.0, 0.5, 0.3], size=(6, 3))
    steps = np.arange(0, 200, 10)
    obstacles = np.zeros((8, 4))
    obstacles[0] = [1.0, 2.0, 0.1, 0.2]

    def wishes(intention, lane):
        return np.array(
            [
                intention.wish(
                    {
                        "pose": lane + k * np.array([0.04, 0.0, 0.0]),
                        "pose_world": lane + k * np.array([0.04, 0.0, 0.0]),
                        "obstacles": np.broadcast_to(obstacles, (*lane.shape[:-1], 8, 4)),
                        "time": np.broadcast_to(0.05 * k, (*lane.shape[:-1], 1)),
                    }
                )
                for k in steps
            ]
        )

    single = [wishes(Intention(settings, CORRIDOR), lane) for lane in lanes]
    together = wishes(Intention(settings, CORRIDOR), lanes)
    np.testing.assert_allclose(together, np.swapaxes(single, 0, 1), atol=1e-12)


@pytest.mark.parametrize(
    ("build", "named"),
    [
        (lambda: ChangeOfMind(pace=0.3), "either at_time"),
        (lambda: ChangeOfMind(at_time=1.0, at_station=1.0, pace=0.3), "either at_time"),
        (lambda: ChangeOfMind(at_time=1.0), "nothing changes"),
        (lambda: ChangeOfMind(pace=-1.0), r"pace = -1\.0 m/s: must lie .*; .*either at_time"),
        (lambda: ChangeOfMind(at_time=-1.0, pace=0.3), r"at_time = -1\.0"),
        (lambda: ChangeOfMind(at_time=1.0, pace=-0.3), r"pace = -0\.3"),
        (lambda: IntentionSettings(lookahead=0.0), r"lookahead = 0\.0"),
        (lambda: IntentionSettings(easing=0.0), r"easing = 0\.0"),
        (lambda: IntentionSettings(margin=-0.1), r"margin = -0\.1"),
    ],
)
def test_impossible_intentions_are_named(build, named):
    with pytest.raises(InputError, match=named):
        build()


def test_an_intention_is_declared_in_the_scenario_and_checked_there():
    scenario = load(
        "puddle",
        [
            "human.intention.path={points: [[0, 0], [8, 0], [8, 20]]}",
            "human.intention.changes=[{at_time: 3.0, pace: 0.0}, {at_station: 2, pace: 0.5}]",
        ],
    )
    assert scenario.human.intention.path == SIDE_CORRIDOR
    assert scenario.human.intention.changes[1] == ChangeOfMind(at_station=2.0, pace=0.5)
    with pytest.raises(InputError, match=r"human\.intention\.changes\.0.*either at_time"):
        load("puddle", ["human.intention.changes=[{pace: 0.5}]"])


def test_a_wish_to_stop_pulls_backwards(observe):
    human = SteadyHuman(intention=IntentionSettings(changes=(ChangeOfMind(at_time=1.0, pace=0.0),)))
    human.reset(np.random.default_rng(0), CORRIDOR)
    before, after = (human.act(observe(twist=(0.8, 0.0), time=t)) for t in (0.95, 1.0))
    np.testing.assert_array_equal(before, 0.0)
    # gain * s * (0 - 0.8)/1.2 of 7.5 N
    np.testing.assert_allclose(after, [-5.0, 0.0])
