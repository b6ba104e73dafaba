"""Humans whose stubbornness moves: one behaviour, or one published number, a test."""

import numpy as np
import pytest

from cowalk.agents.humans.bounded_memory import BoundedMemoryHuman
from cowalk.agents.humans.conceding import ConcedingHuman
from cowalk.agents.humans.crossover import CrossoverHuman
from cowalk.agents.humans.escalating import EscalatingHuman
from cowalk.agents.humans.game import GameHuman
from cowalk.agents.humans.impedance import ImpedanceHuman
from cowalk.agents.humans.open_loop import OpenLoopHuman
from cowalk.agents.humans.slacking import SlackingHuman
from cowalk.agents.humans.steady import SteadyHuman
from cowalk.agents.humans.tit_for_tat import TitForTatHuman
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import arc_displacement, compose

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


def test_force_escalates_from_a_quarter_newton_as_in_the_published_pairs(situation, observe):
    # Shergill et al. 2003: from a push of 0.25 N, 38 % a turn, 3.2 N more after 8 turns;
    # 38 %, a rounded mean of six pairs, makes 3.04 N of it.
    human = EscalatingHuman(initial=(0.07, 0.07), growth=0.38, turn=2.0)
    human.reset(NO_RNG, situation)
    turning = 0.25 / (7.5 * 2.0 * 0.07) * 0.5
    forces = [-human.act(observe(twist=(0.8, turning)))[1] for _ in range(8 * 40 + 1)][::40]
    assert forces[0] == pytest.approx(0.25, rel=0.01)  # a control step into the first turn
    np.testing.assert_allclose(np.divide(forces[1:], forces[:-1]), 1.38, rtol=1e-9)
    assert forces[8] - forces[0] == pytest.approx(3.2, rel=0.06)


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


def levels_against(human, situation, observe, omegas):
    """Return the stubbornness in omega of a human on their path, who wants 0 rad/s there."""
    human.reset(np.random.default_rng(0), situation)
    levels = []
    for omega in omegas:
        human.act(observe(twist=(0.8, omega)))
        levels.append(human.truth().stubbornness[1])
    return np.array(levels)


@pytest.mark.parametrize("beta", [0.2, 1.0, 5.0])
def test_time_based_concession_runs_between_its_published_ends(situation, observe, beta):
    human = ConcedingHuman(initial=(0.9, 0.9), final=(0.1, 0.1), beta=beta, deadline=5.0)
    levels = levels_against(human, situation, observe, [0.3] * 140)
    assert levels[0] == 0.9
    assert levels[100:] == pytest.approx(0.1)
    # Faratin et al. 1998: alpha(t) = (t/t_max)^(1/beta)
    assert levels[50] == pytest.approx(0.9 - 0.8 * 0.5 ** (1.0 / beta))


def test_boulware_holds_out_conceder_gives_in_and_agreement_ends_a_negotiation(situation, observe):
    halfway = [
        levels_against(ConcedingHuman(beta=beta), situation, observe, [0.3] * 101)[100]
        for beta in (0.2, 1.0, 5.0)
    ]
    assert halfway[0] > 0.95
    assert halfway[1] == pytest.approx(0.5)
    assert halfway[2] < 0.15
    again = levels_against(ConcedingHuman(), situation, observe, [0.3] * 250 + [0.0] + [0.3])
    assert again[249] == 0.0
    assert again[251] == 1.0


def test_tit_for_tat_mirrors_each_concession_and_each_withdrawal(situation, observe):
    omegas = [0.4, 0.4, 0.3, 0.3, 0.15, 0.3]
    levels = levels_against(TitForTatHuman(initial=(0.8, 0.8)), situation, observe, omegas)
    # Conceded: nothing, nothing, a quarter, nothing, half; then as much is withdrawn.
    np.testing.assert_allclose(levels, [0.8, 0.8, 0.6, 0.6, 0.3, 0.6])


def test_a_withdrawal_taken_back_leaves_no_trace_even_beyond_full_stubbornness(situation, observe):
    human = TitForTatHuman(initial=(0.8, 0.8))
    levels = levels_against(human, situation, observe, [0.3, 0.5, 0.3, 0.5, 0.3])
    np.testing.assert_allclose(levels, [0.8, 1.0, 0.8, 1.0, 0.8])


def test_a_wish_that_moves_is_no_concession(situation, observe):
    human = TitForTatHuman(initial=(0.8, 0.8))
    human.reset(NO_RNG, situation)
    for offset in (0.0, 0.3, -0.2):
        human.act(observe(twist=(0.8, 0.2), pose=(0.0, offset, 0.0)))
        assert human.truth().stubbornness[1] == pytest.approx(0.8)


def weave(human, situation, observe, amplitude, period, cycles=3):
    """Return the stubbornness in omega, cycle by cycle, of a human whom the base weaves about."""
    human.reset(NO_RNG, situation)
    steps = round(period / situation.period)
    pose, levels = np.zeros(3), []
    for step in range(cycles * steps):
        omega = amplitude * np.cos(2.0 * np.pi * step / steps)
        human.act(observe(twist=(0.8, omega), pose=tuple(pose)))
        levels.append(human.truth().stubbornness[1])
        pose = compose(pose, arc_displacement(np.array([0.8, omega]), situation.period))
    return np.reshape(levels, (cycles, steps))


@pytest.mark.parametrize(("amplitude", "period"), [(0.1, 6.0), (0.15, 10.0)])
def test_a_wish_and_a_twist_that_both_weave_leave_no_trace(amplitude, period, situation, observe):
    cycles = weave(TitForTatHuman(initial=(0.8, 0.8)), situation, observe, amplitude, period)
    assert (cycles >= 0.0).all()
    assert (cycles <= 1.0).all()
    # Nothing absorbs and nothing winds up: each cycle ranges as the one before.
    assert (cycles.max(axis=1) >= 0.8).all()
    assert (cycles.min(axis=1) <= 0.4).all()


def test_agreement_ends_what_was_conceded_and_withdrawn(situation, observe):
    human = TitForTatHuman(initial=(0.8, 0.8))
    omegas = [0.4, 0.1, 0.0, 0.3, 0.15, -0.2]
    levels = levels_against(human, situation, observe, omegas)
    # Three quarters conceded; agreed; a new one, from where they agreed; the other way round.
    assert levels[1] == pytest.approx(0.2)
    assert levels[2] == levels[5] == 0.8
    assert levels[3] == 1.0


def test_effort_decays_geometrically_without_error(situation, observe):
    human = SlackingHuman(forgetting=0.7, turn=0.5, initial=(0.9, 0.9))
    levels = levels_against(human, situation, observe, [0.0] * 101)
    np.testing.assert_allclose(levels[::10], 0.9 * 0.7 ** np.arange(11))


def test_force_obeys_the_published_law_while_an_error_lasts(situation, observe):
    f, g, error = 0.8, 0.2, -0.6
    human = SlackingHuman(forgetting=f, learning=g, turn=0.5, gain=1.0, initial=(0.5, 0.5))
    human.reset(NO_RNG, situation)
    forces = [human.act(observe(twist=(0.8, 0.3)))[1] for _ in range(301)][::10]
    # Emken et al. 2007: F_{i+1} = f F_i + g e_i, here with g |e| F_max for each unit of e.
    expected = f * np.array(forces[:-1]) + g * abs(error) * 7.5 * error
    np.testing.assert_allclose(forces[1:], expected)
    assert forces[-1] == pytest.approx(g * abs(error) * 7.5 * error / (1.0 - f), rel=0.01)


@pytest.mark.parametrize("alpha", [0.0, 0.25, 0.5, 0.75, 1.0])
@pytest.mark.parametrize("memory", [1, 3])
def test_modes_switch_with_the_frequency_of_adaptability(situation, observe, alpha, memory):
    people = 4000
    human = BoundedMemoryHuman(adaptability=alpha, memory=memory, turn=0.5)
    human.reset(np.random.default_rng(5), situation)
    one = observe(twist=(0.8, 0.3))
    batch = {key: np.repeat(value[None], people, axis=0) for key, value in one.items()}
    kept = []
    for _ in range(61):  # the start and six turns of 10 steps
        human.act(batch)
        truth = human.truth()
        kept.append(np.mean(truth.wish[:, 1] == 0.0))
        np.testing.assert_array_equal(truth.stubbornness, 1.0 - alpha)
    kept = np.array(kept)[::10]
    np.testing.assert_array_equal(kept[:memory], 1.0)  # memory not yet full
    expected = (1.0 - alpha) ** np.arange(1, 8 - memory)
    error = 4.0 * np.sqrt(expected * (1.0 - expected) / people)
    assert (np.abs(kept[memory:] - expected) <= error).all()


def test_an_adopted_mode_is_left_when_the_robot_does_what_was_intended(situation, observe):
    human = BoundedMemoryHuman(adaptability=1.0, memory=2, turn=0.5)
    human.reset(np.random.default_rng(0), situation)
    wishes = []
    for omega in [0.3] * 25 + [0.0] * 25 + [0.3]:
        human.act(observe(twist=(0.8, omega)))
        wishes.append(human.truth().wish[1])
    assert wishes[19] == 0.0
    assert wishes[20] == 0.3  # two turns of disagreement
    assert wishes[50] == 0.0  # two turns of agreement later: their own again


FIXED_POINTS = {
    # What stubbornness settles at when the automation gives a share c of the disagreement D
    # away for good, and when it gives as much as the human is stubborn (docs/humans.md).
    "steady": (SteadyHuman(level=(0.6, 0.6)), lambda c, d: 0.6, lambda d: 0.6),
    "conceding": (ConcedingHuman(final=(0.2, 0.2)), lambda c, d: 0.2, lambda d: 0.2),
    "tit-for-tat": (
        TitForTatHuman(initial=(0.8, 0.8), tolerance=0.01),
        lambda c, d: 0.8 * (1.0 - c),
        lambda d: 0.8 / 1.8,
    ),
    "slacking": (
        SlackingHuman(forgetting=0.8, learning=0.2),
        lambda c, d: (1.0 - c) * d,
        lambda d: d / (1.0 + d),
    ),
    "bounded-memory": (
        BoundedMemoryHuman(adaptability=0.25),
        lambda c, d: 0.75,
        lambda d: 0.75,
    ),
    "escalating": (
        EscalatingHuman(initial=(0.2, 0.2), turn=2.0, relaxation=1.0, tolerance=2.0),
        lambda c, d: 0.2 / (1.0 - odds(c, d) * np.log(1.38) / 2.0),
        None,
    ),
}


def odds(c, d):
    unresolved = (1.0 - c) * d / 2.0
    return unresolved / (1.0 - unresolved)


@pytest.mark.parametrize("name", FIXED_POINTS)
@pytest.mark.parametrize("conceded", [0.0, 0.5, 0.75])
def test_stubbornness_settles_where_derived(name, conceded, situation, observe):
    human, expected, _ = FIXED_POINTS[name]
    omegas = np.full(800, 0.4 * (1.0 - conceded))
    omegas[0] = 0.4
    levels = levels_against(human, situation, observe, omegas)
    assert levels[-1] == pytest.approx(expected(conceded, 0.8), rel=0.01)


@pytest.mark.parametrize("name", [n for n, point in FIXED_POINTS.items() if point[2]])
def test_stubbornness_settles_against_an_automation_that_yields_to_it(name, situation, observe):
    human, _, expected = FIXED_POINTS[name]
    human.reset(np.random.default_rng(0), situation)
    yielded = 0.0
    for _ in range(1200):
        human.act(observe(twist=(0.8, 0.4 * (1.0 - yielded))))
        level = human.truth().stubbornness[1]
        yielded += 0.05 * (level - yielded)  # smoothed, as every negotiating automation does
    assert level == pytest.approx(expected(0.8), rel=0.02)


@pytest.mark.parametrize(
    ("build", "named"),
    [
        (lambda: SteadyHuman(level=(0.5, 1.5)), r"level = .*1\.5"),
        (lambda: EscalatingHuman(turn=0.0), r"turn = 0\.0"),
        (lambda: EscalatingHuman(initial=(0.0, 0.0)), r"initial = .*what is 0 never grows"),
        (lambda: EscalatingHuman(initial=(0.4, 0.0)), r"initial = .*must be 0\.001 or more"),
        (lambda: SteadyHuman(level=0.5), r"level = 0\.5: must be two numbers, for v and for omega"),
        (lambda: SteadyHuman(level=(0.5,)), r"level = .*must be two numbers"),
        (lambda: SteadyHuman(level=(np.nan, 0.5)), r"level = .*must lie between 0 and 1$"),
        (lambda: GameHuman(error_weights=1.0), r"error_weights = 1\.0: must be two numbers"),
        (lambda: EscalatingHuman(growth=-1.0), r"growth = -1\.0"),
        (lambda: SteadyHuman(gain=0.0), r"gain = 0\.0"),
        (lambda: SteadyHuman(force_max=(0.0, 1.0)), "force_max"),
        (lambda: ConcedingHuman(beta=0.0), r"beta = 0\.0"),
        (lambda: TitForTatHuman(initial=(0.0, 1.0)), "initial"),
        (lambda: SlackingHuman(forgetting=1.0), r"forgetting = 1\.0"),
        (lambda: BoundedMemoryHuman(adaptability=1.2), r"adaptability = 1\.2"),
        (lambda: BoundedMemoryHuman(memory=0), "memory = 0"),
        (lambda: ImpedanceHuman(damping=0.0), r"damping = 0\.0"),
        (lambda: CrossoverHuman(delay=-0.1), r"delay = -0\.1"),
        (lambda: GameHuman(effort_weight=0.0), r"effort_weight = 0\.0"),
        (lambda: OpenLoopHuman(profile=((2.0, 0.0, 0.0), (1.0, 0.0, 0.0))), "profile"),
    ],
)
def test_impossible_parameters_are_named(build, named):
    with pytest.raises(InputError, match=named):
        build()
