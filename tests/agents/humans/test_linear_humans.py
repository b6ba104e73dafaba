"""Impedance, crossover and game: their own published laws, beside the common definition."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cowalk.agents.basics.elementwise import ARRAYS, FLOATS
from cowalk.agents.humans.crossover import CrossoverHuman
from cowalk.agents.humans.game import GameHuman
from cowalk.agents.humans.impedance import ImpedanceHuman
from cowalk.agents.humans.intention.intention import IntentionSettings
from cowalk.agents.humans.intention.minimum_jerk import Movement, minimum_jerk
from cowalk.agents.humans.laws.lq_game import best_answer, nash_equilibrium, regulator

NO_RNG = np.random.default_rng(0)
UPPER = np.array([1.2, 0.5])


def test_minimum_jerk_starts_and_ends_at_rest_and_peaks_at_15_eighths():
    share = np.linspace(0.0, 1.0, 2001)
    progress, speed = minimum_jerk(share)
    np.testing.assert_allclose(progress, np.polyval([6, -15, 10, 0, 0, 0], share), atol=1e-12)
    np.testing.assert_allclose(speed, np.gradient(progress, share, edge_order=2), atol=1e-5)
    assert speed.max() == speed[1000] == pytest.approx(15.0 / 8.0)
    assert progress[0] == speed[0] == speed[-1] == 0.0
    assert progress[-1] == 1.0


goals = st.lists(st.floats(-2.0, 2.0), min_size=1, max_size=6)


@settings(max_examples=40, deadline=None)
@given(goals, st.floats(0.002, 0.05))
def test_a_goal_that_changes_bends_a_movement_without_a_jump(goals, step):
    movement, places, speeds = Movement(0.0), [], []
    for goal in goals:
        for _ in range(round(0.4 / step)):  # each is left before it is reached
            movement.aim(FLOATS, goal)
            places.append(movement.place())
            speeds.append(movement.speed())
            movement.advance(FLOATS, step)
    bend = 1000.0 * step  # acceleration of the longest movements, each begun in motion
    assert np.abs(np.diff(speeds)).max(initial=0.0) < bend
    np.testing.assert_allclose(np.diff(places), step * np.array(speeds[1:]), atol=bend * step)
    movement.advance(FLOATS, 1.0)
    assert movement.place() == pytest.approx(goals[-1], abs=1e-3)
    assert movement.speed() == pytest.approx(0.0, abs=1e-9)


def test_a_movement_of_a_batch_is_that_of_each():
    lanes = np.array([0.5, -0.3, 0.0])
    alone, together = [Movement(0.0) for _ in lanes], Movement(0.0)
    for k in range(40):
        goals = np.where(k < 11, lanes, lanes[::-1])
        together.aim(ARRAYS, goals)
        for movement, goal in zip(alone, goals, strict=True):
            movement.aim(FLOATS, goal)
        np.testing.assert_allclose(together.place(), [movement.place() for movement in alone])
        for movement, elements in ((together, ARRAYS), *((one, FLOATS) for one in alone)):
            movement.advance(elements, 0.04)


def test_the_hand_pulls_along_a_minimum_jerk_profile(situation, observe):
    """Held where it is, the base shows the spring and damper of the whole movement sideways."""
    K, B, T, puddle = 60.0, 5.0, 3.0, ((3.0, -0.7, 0.35),)
    human = ImpedanceHuman(stiffness=K, damping=B, duration=T, force_max=(100.0, 100.0))
    human.reset(NO_RNG, situation)
    forces = [human.act(observe(twist=(0.8, 0.0), obstacles=puddle))[1] for _ in range(101)]
    s = np.minimum(np.arange(101) * 0.05 / T, 1.0)
    length = -0.7 + 0.35 + 0.15 + 0.87  # the detour to the left that the intention asks for
    place = length * (10 * s**3 - 15 * s**4 + 6 * s**5)
    speed = length / T * (30 * s**2 - 60 * s**3 + 30 * s**4)
    np.testing.assert_allclose(forces, K * place + B * speed, atol=1e-9)


def test_impedance_is_a_spring_along_the_base_as_far_as_the_arm_reaches(situation, observe):
    human = ImpedanceHuman(stiffness=50.0, damping=10.0, reach=0.1, force_max=(100.0, 100.0))
    human.reset(NO_RNG, situation)
    forces = [human.act(observe(twist=(0.6, 0.0)))[0] for _ in range(40)]
    lag = np.minimum(0.2 * 0.05 * np.arange(1, 41), 0.1)
    np.testing.assert_allclose(forces, 50.0 * lag + 10.0 * 0.2)


@pytest.mark.parametrize(("damping", "gain"), [(5.0, 2.0), (10.0, 2.0), (25.0, 6.0)])
def test_damping_is_stubbornness(damping, gain, situation, observe):
    human = ImpedanceHuman(damping=damping, lever=1.0, gain=gain)
    human.reset(NO_RNG, situation)
    human.act(observe(twist=(0.8, 0.01)))
    expected = damping * UPPER / (gain * np.array([7.5, 7.5]))
    np.testing.assert_allclose(human.truth().stubbornness, expected)


def test_a_wish_beyond_the_bounds_is_the_wish_for_the_bound_held_more_stubbornly(
    situation, observe
):
    human = ImpedanceHuman(stiffness=50.0, damping=5.0, lever=1.6, duration=0.05)
    human.reset(NO_RNG, situation)
    for _ in range(3):
        force = human.act(observe(obstacles=((3.0, -1.0, 0.35),)))
    truth = human.truth()
    level = 5.0 * 1.6 * 0.5 / 15.0
    assert level < truth.stubbornness[1] <= 1.0
    assert truth.wish[1] == 0.5
    assert force[1] == pytest.approx(min(50.0 * (-1.0 + 0.35 + 0.15 + 0.87), 7.5))


def frequency_response(human, situation, observe, frequency, dimension):
    """Return Y_p(j omega): from what is missing in the twist to force, N s/m or N s/rad."""
    human.reset(NO_RNG, situation)
    time = np.arange(0.0, 40.0 * np.pi / frequency, situation.period)
    amplitude = 0.01
    missing = amplitude * np.sin(frequency * time)
    forces = []
    for gap in missing:
        twist = np.array([0.8, 0.0])
        twist[dimension] -= gap
        forces.append(human.act(observe(twist=twist))[dimension])
    settled = slice(len(time) // 2, None)
    basis = np.stack((np.sin(frequency * time), np.cos(frequency * time)), axis=-1)[settled]
    in_phase, ahead = np.linalg.lstsq(basis, np.array(forces)[settled], rcond=None)[0]
    return complex(in_phase, ahead) / amplitude


@pytest.mark.parametrize("dimension", [0, 1])
@pytest.mark.parametrize(("crossover", "delay"), [(2.0, 0.3), (3.0, 0.2), (5.0, 0.15)])
def test_the_open_loop_crosses_over_as_mcruer_found(
    crossover, delay, dimension, situation, observe
):
    human = CrossoverHuman(crossover_frequency=crossover, delay=delay)
    effect = human.steering * UPPER[dimension] / 7.5  # K of Y_c = K/(j omega)
    frequencies = crossover * np.array([0.25, 0.5, 1.0, 2.0])
    open_loop = np.array(
        [
            frequency_response(human, situation, observe, w, dimension) * effect / (1j * w)
            for w in frequencies
        ]
    )
    slope = np.polyfit(np.log(frequencies), np.log(np.abs(open_loop)), 1)[0]
    assert slope == pytest.approx(-1.0, abs=1e-6)
    assert np.abs(open_loop[2]) == pytest.approx(1.0, abs=1e-6)
    phase = np.unwrap(np.angle(open_loop))
    np.testing.assert_allclose(phase, -np.pi / 2.0 - frequencies * delay, atol=1e-6)


def test_crossover_frequency_is_stubbornness(situation, observe):
    for crossover, expected in ((2.0, 0.5), (3.0, 0.75), (5.0, 1.0)):
        human = CrossoverHuman(crossover_frequency=crossover, steering=2.0, gain=2.0)
        human.reset(NO_RNG, situation)
        human.act(observe(twist=(0.8, 0.02)))
        np.testing.assert_allclose(human.truth().stubbornness, expected)


gains = st.floats(-2.0, 4.0)
weights = st.floats(0.1, 5.0)


def test_the_regulator_of_a_double_integrator_is_the_textbooks():
    textbook = [1.0, np.sqrt(3.0)]
    np.testing.assert_allclose(best_answer(FLOATS, (0.0, 0.0), (1.0, 1.0), 1.0, 1.0), textbook)
    np.testing.assert_allclose(regulator((0.0, 0.0), (1.0, 1.0), 1.0, 1.0), textbook)


@settings(max_examples=40, deadline=None)
@given(gains, gains, weights, weights, weights, st.floats(0.5, 4.0))
def test_the_closed_form_solves_the_riccati_equation(l1, l2, q1, q2, r, steering):
    answer = best_answer(FLOATS, (l1, l2), (q1, q2), r, steering)
    np.testing.assert_allclose(
        answer, regulator((l1, l2), (q1, q2), r, steering), rtol=1e-5, atol=1e-6
    )


@pytest.mark.parametrize("efforts", [(1.0, 1.0), (1.0, 3.0), (0.2, 1.0)])
def test_in_equilibrium_each_plays_the_regulator_of_what_the_other_leaves(efforts):
    own, other = nash_equilibrium((1.5, 0.8), efforts, 2.0)
    for player, partner, effort in ((own, other, efforts[0]), (other, own, efforts[1])):
        answer = best_answer(FLOATS, partner, (1.5, 0.8), effort, 2.0)
        np.testing.assert_allclose(player, answer, rtol=1e-6)


def test_a_game_human_begins_in_the_equilibrium(situation, observe):
    human = GameHuman(effort_weight=2.0, partner_effort_weight=0.5)
    human.reset(NO_RNG, situation)
    own, other = nash_equilibrium((1.0, 1.0), (2.0, 0.5), 2.0)
    assert human.partner_gains() == (other, other)
    human.act(observe())
    assert human.slope(1) * 0.5 / 7.5 == pytest.approx(own[1], rel=1e-6)


def test_equal_players_share_the_work_as_the_symmetric_riccati_equation_says():
    own, other = nash_equilibrium((1.5, 0.8), (2.0, 2.0), 2.0)
    # g_1^2 + 2 g_1 g_1 = q_1/r, and likewise for g_2
    first = np.sqrt(1.5 / 2.0 / 3.0)
    np.testing.assert_allclose(own, [first, np.sqrt((0.8 / 2.0 + 2.0 * first / 2.0) / 3.0)])
    np.testing.assert_allclose(own, other)


def play_with(partner, situation, observe, **parameters):
    """Let a partner with a law of their own and a game human turn one base; return the human."""
    human = GameHuman(force_max=(100.0, 100.0), **parameters)
    human.reset(NO_RNG, situation)
    T, steering = situation.period, human.steering
    heading, rate = 0.3, 0.0
    for k in range(4000):
        if k % 60 == 0:  # something pushes them off, or there would be nothing to learn
            heading = 0.3 * (-1.0) ** (k // 60)
        force = human.act(observe(twist=(0.8, rate * 0.5), pose=(0.0, 0.0, heading)))
        reply = -partner[0] * heading / 0.5 - partner[1] * rate
        rate += T * steering * (force[1] / 100.0 + reply)
        heading += T * rate * 0.5
    return human


@pytest.mark.parametrize("partner", [(1.0, 1.5), (0.0, 0.0), (-0.4, 0.5)])
def test_the_observer_finds_the_partners_gain_and_the_human_answers_it(partner, situation, observe):
    human = play_with(partner, situation, observe, observer_rate=4.0)
    np.testing.assert_allclose(human.partner_gains()[1], partner, atol=0.1)
    answer = regulator(human.partner_gains()[1], (1.0, 1.0), 1.0, 2.0)
    slope = human.slope(1) * 0.5 / 100.0
    assert slope == pytest.approx(answer[1], rel=1e-6)


def test_a_partner_who_helps_makes_the_human_less_stubborn(situation, observe):
    levels = [
        play_with((0.0, gain), situation, observe).truth().stubbornness[1]
        for gain in (-0.5, 0.5, 2.0)
    ]
    assert levels[0] > levels[1] > levels[2]


def test_who_wants_to_stand_does_not_turn(situation, observe):
    human = GameHuman(intention=IntentionSettings(pace=0.0))
    human.reset(NO_RNG, situation)
    force = human.act(observe(twist=(0.3, 0.0), pose=(0.0, 0.5, 0.2)))
    assert force[0] < 0.0
    assert force[1] == 0.0
