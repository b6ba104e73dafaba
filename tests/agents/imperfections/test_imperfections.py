"""Each imperfection alone, against the number that is published or follows from its law."""

import pathlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from cowalk.agents import IMPERFECTIONS, Truth
from cowalk.agents.imperfections.fatigue import RATES, Fatigue
from cowalk.agents.imperfections.force_limit import ForceLimit
from cowalk.agents.imperfections.gait_ripple import GaitRipple
from cowalk.agents.imperfections.perception_threshold import PerceptionThreshold
from cowalk.agents.imperfections.reaction_delay import ReactionDelay
from cowalk.agents.imperfections.signal_dependent_noise import SignalDependentNoise
from cowalk.agents.imperfections.tremor import Tremor
from cowalk.sim import Situation
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import TwistBounds
from cowalk.sim.basics.path import Path

PERIOD = 0.05


class Pushing:
    """A human who gives the forces of a list, the last one for ever; shape (steps, ..., 2)."""

    def __init__(self, forces):
        self.forces = np.asarray(forces, dtype=float)
        self.felt = []

    def reset(self, rng, situation):
        self.step = -1
        self.first_draw = rng.random()

    def act(self, observation):
        self.felt.append(np.array(observation["force"]))
        self.step = min(self.step + 1, len(self.forces) - 1)
        return self.forces[self.step].copy()

    def truth(self):
        return Truth(np.array([0.7, 0.1]), np.array([0.25, 0.75]))


def at_rate(rate):
    bounds = TwistBounds((0.0, -0.5), (1.2, 0.5))
    return Situation(Path(((0.0, 0.0), (30.0, 0.0))), 0.8, bounds, 1.0 / rate)


def play(human, steps, rate=20, twist=(0.8, 0.0), seed=0):
    """Return the forces of ``steps`` control steps, shape (steps, ..., 2)."""
    human.reset(np.random.default_rng(seed), at_rate(rate))
    seen = {
        "twist": np.array(twist, dtype=float),
        "force": np.zeros((12, 2)),
        "pose": np.zeros(3),
        "pose_world": np.zeros(3),
        "obstacles": np.zeros((8, 4)),
        "time": np.zeros(1),
    }
    return np.array([human.act(seen) for _ in range(steps)])


STEP = [[0.0, 0.0]] * 3 + [[4.0, -2.0]] * 20


@pytest.mark.parametrize("delay", [0.0, 0.05, 0.15, 0.2, 0.25])
def test_the_delayed_force_is_the_force_of_a_delay_ago(delay):
    forces = play(ReactionDelay(Pushing(STEP), delay=delay), 23)
    shift = round(delay / PERIOD)
    np.testing.assert_array_equal(forces[shift:], STEP[: 23 - shift])
    np.testing.assert_array_equal(forces[:shift], 0.0)


@given(st.floats(0.0, 0.5))
def test_a_delay_between_two_steps_keeps_the_time_at_which_half_has_arrived(delay):
    # The integral of what is missing is the force times the delay, whole periods or not.
    forces = play(ReactionDelay(Pushing(STEP), delay=delay), 23)
    missing = (np.array(STEP) - forces).sum(axis=0) * PERIOD
    np.testing.assert_allclose(missing, np.array([4.0, -2.0]) * delay, atol=1e-6)


@pytest.mark.parametrize("weber", [0.08, 0.10, 0.13])
@pytest.mark.parametrize("reference", [1.0, 3.0, 10.0])
def test_a_staircase_recovers_the_weber_fraction(weber, reference):
    """One up, two down, halving its step: the textbook staircase, run on the wrapper."""

    def tells_apart(difference):
        observer = Pushing([[0.0, 0.0]])
        human = PerceptionThreshold(observer, weber=weber)
        human.reset(np.random.default_rng(0), at_rate(20))
        for force in (reference, reference + difference):
            human.act({"force": np.full((12, 2), [force, 0.0]), "twist": np.zeros(2)})
        return observer.felt[1][0, 0] != observer.felt[0][0, 0]

    difference, step, told, direction, reversals = 0.5 * reference, 0.1 * reference, 0, 0, []
    while len(reversals) < 16:
        told = told + 1 if tells_apart(difference) else 0
        move = 1 if told == 0 else -1 if told == 2 else 0
        if move and direction and move != direction:
            reversals.append(difference)
            step /= 2.0
        direction = move or direction
        told = 0 if told == 2 else told
        difference += move * step
    assert np.mean(reversals[-6:]) / reference == pytest.approx(weber, rel=0.02)


def test_what_is_below_the_absolute_threshold_is_not_felt():
    observer = Pushing([[0.0, 0.0]])
    human = PerceptionThreshold(observer, threshold=0.04)
    human.reset(np.random.default_rng(0), at_rate(20))
    for force in (0.03, 0.05):
        human.act({"force": np.full((12, 2), [0.0, force]), "twist": np.zeros(2)})
    assert [felt[0, 1] for felt in observer.felt] == pytest.approx([0.0, 0.05])


def test_a_push_is_corrected_only_by_what_can_be_felt():
    ramp = np.linspace([0.0, 0.0], [10.0, 0.0], 400)
    forces = play(PerceptionThreshold(Pushing(ramp), weber=0.1), 400)[:, 0]
    levels = np.unique(forces[forces > 1.0])
    assert (np.diff(levels) > 0.1 * levels[:-1]).all()
    assert np.abs(forces - ramp[:, 0]).max() <= 0.1 * 10.0 + 0.04


@pytest.mark.parametrize("share", [0.02, 0.05])
def test_the_noise_grows_with_the_force_by_the_share_stated(share):
    forces = np.array([1.0, 3.0, 10.0, 30.0])
    lanes = np.stack((forces, np.zeros(4)), axis=-1)[None]
    noisy = play(SignalDependentNoise(Pushing(lanes), share=share), 4000)
    deviation = noisy[..., 0].std(axis=0)
    slope = np.polyfit(forces, deviation, 1)[0]
    assert slope == pytest.approx(share, rel=0.03)  # standard error 1.1 % at 4000 draws
    np.testing.assert_allclose(noisy[..., 0].mean(axis=0), forces, rtol=0.01)
    assert (noisy[..., 1] == 0.0).all()


def spectrum(signal, rate):
    """Return frequencies in Hz and amplitudes of a real signal."""
    amplitude = 2.0 * np.abs(np.fft.rfft(signal)) / len(signal)
    return np.fft.rfftfreq(len(signal), 1.0 / rate), amplitude


@pytest.mark.parametrize(("rate", "frequency"), [(20, 8.0), (20, 9.0), (60, 8.0), (60, 12.0)])
def test_tremor_is_one_line_of_the_stated_height_in_the_spectrum(rate, frequency):
    forces = play(Tremor(Pushing([[0.0, 5.0]]), share=0.01, frequency=frequency), 10 * rate, rate)
    frequencies, amplitudes = spectrum(forces[:, 1] - 5.0, rate)
    peak = np.argmax(amplitudes)
    assert frequencies[peak] == pytest.approx(frequency)
    assert amplitudes[peak] == pytest.approx(0.05)
    assert np.delete(amplitudes, peak).max() < 1e-10


def test_what_a_held_force_leaves_of_a_tremor_is_what_the_documentation_says():
    for rate, frequency, share in ((20, 9.0, 0.70), (60, 12.0, 0.94)):
        forces = play(Tremor(Pushing([[0.0, 5.0]]), frequency=frequency), 10 * rate, rate)
        held = np.repeat(forces[:, 1] - 5.0, 960 // rate)
        frequencies, amplitudes = spectrum(held, 960)
        assert amplitudes[frequencies == frequency] == pytest.approx(0.05 * share, rel=0.01)


@pytest.mark.parametrize("frequency", [10.0, 11.0, 12.0])
def test_tremor_that_would_alias_is_refused_with_the_rate_that_would_do(frequency):
    with pytest.raises(InputError, match=rf"rates.control above {2 * frequency:g}"):
        play(Tremor(Pushing([[0.0, 5.0]]), frequency=frequency), 1, rate=20)
    assert len(play(Tremor(Pushing([[0.0, 5.0]]), frequency=frequency), 1, rate=60)) == 1


@pytest.mark.parametrize(("muscle", "endurance"), [("shoulder", 58), ("elbow", 116), ("grip", 106)])
def test_half_of_the_strength_lasts_as_long_as_published(muscle, endurance):
    human = Fatigue(Pushing([[18.0, -24.0]]), muscle=muscle, strength=60.0)
    size = np.hypot(*play(human, 3000).T)
    failure = np.argmax(size < 30.0 * (1.0 - 1e-9)) * PERIOD
    assert failure == pytest.approx(endurance, rel=0.05)
    assert (np.diff(size) <= 1e-12).all()


@pytest.mark.parametrize("muscle", list(RATES))
@pytest.mark.parametrize("load", [0.3, 0.7])
def test_fatigue_follows_the_published_equations_with_their_activation_drive(muscle, load):
    """The differential equations of Xia and Frey-Law with L_D = L_R = 10/s, integrated."""
    fatigue, recovery = RATES[muscle]

    def change(_, compartments):
        resting, active, fatigued = compartments
        missing = load - active
        drive = 10.0 * (min(missing, resting) if missing > 0.0 else missing)
        return (
            -drive + recovery * fatigued,
            drive - fatigue * active,
            fatigue * active - recovery * fatigued,
        )

    times = np.arange(1, 241) * 1.0
    published = solve_ivp(change, (0.0, 240.0), (1.0, 0.0, 0.0), "LSODA", times, max_step=0.5)
    ours = play(Fatigue(Pushing([[load * 60.0, 0.0]]), muscle=muscle), 4801)[20::20, 0] / 60.0
    np.testing.assert_allclose(ours, published.y[1], atol=0.01)


def test_rest_restores_the_strength():
    fatigue, recovery = RATES["shoulder"]
    human = Fatigue(Pushing([[60.0, 0.0]] * 2400 + [[0.0, 0.0]] * 2400), strength=60.0)
    play(human, 2400)
    tired = human.fatigued
    # At full effort M_F approaches F/(F + R).
    expected = fatigue / (fatigue + recovery) * -np.expm1(-(fatigue + recovery) * 120.0)
    assert tired == pytest.approx(expected, rel=0.001)
    play(human, 4800)
    assert human.fatigued == pytest.approx(tired * np.exp(-recovery * 120.0), rel=0.001)


@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(0.1, 100.0))
def test_the_limit_bounds_the_size_and_keeps_the_direction(fx, fy, limit):
    force = play(ForceLimit(Pushing([[fx, fy]]), limit=limit), 1)[0]
    asked = np.hypot(fx, fy)
    assert np.hypot(*force) == pytest.approx(min(asked, limit), rel=1e-9, abs=1e-12)
    assert force[0] * fy == pytest.approx(force[1] * fx, abs=1e-6 * limit * max(asked, 1.0))


def test_gait_ripple_has_the_measured_size_at_step_frequency_and_at_half_of_it():
    human = GaitRipple(Pushing([[0.0, 0.0]]), step_frequency=1.8)
    forces = play(human, 60 * 100, rate=60)
    for axis, frequency, sway in ((0, 1.8, 0.042), (1, 0.9, 0.067)):
        frequencies, amplitudes = spectrum(forces[:, axis], 60)
        peak = np.argmax(amplitudes)
        assert frequencies[peak] == pytest.approx(frequency)
        # Half of the sway, peak to peak, through 100 N/m: about as large as the paper's pushes.
        assert amplitudes[peak] == pytest.approx(100.0 * sway / 2.0, rel=1e-6)
        assert np.ptp(forces[:, axis]) == pytest.approx(100.0 * sway, rel=0.01)


def test_a_standing_human_has_no_gait():
    assert (play(GaitRipple(Pushing([[0.0, 2.0]])), 40, twist=(0.0, 0.3)) == [0.0, 2.0]).all()


def test_the_human_inside_draws_the_same_numbers_with_and_without():
    bare, wrapped = Pushing([[0.0, 5.0]]), Pushing([[0.0, 5.0]])
    play(bare, 1)
    play(Tremor(SignalDependentNoise(wrapped)), 1)
    assert bare.first_draw == wrapped.first_draw


def test_two_of_a_kind_draw_numbers_of_their_own():
    once = play(SignalDependentNoise(Pushing([[0.0, 1.0]]), share=0.1), 500)[:, 1]
    twice = play(SignalDependentNoise(SignalDependentNoise(Pushing([[0.0, 1.0]]), 0.1), 0.1), 500)
    assert np.std(twice[:, 1]) == pytest.approx(np.sqrt(2.0) * np.std(once), rel=0.15)


BAD = {
    "reaction-delay": {"delay": -0.1},
    "perception-threshold": {"weber": 1.0},
    "signal-dependent-noise": {"share": -0.1},
    "tremor": {"frequency": 50.0},
    "fatigue": {"strength": 0.0},
    "force-limit": {"limit": 0.0},
    "gait-ripple": {"lateral_sway": -0.1},
}


@pytest.mark.parametrize("name", IMPERFECTIONS.names())
def test_a_parameter_out_of_range_is_named(name):
    (parameter, value), *_ = BAD[name].items()
    with pytest.raises(InputError, match=f"{parameter} = {value}"):
        IMPERFECTIONS.get(name)(Pushing([[0.0, 0.0]]), **{parameter: value})


@pytest.mark.parametrize("name", IMPERFECTIONS.names())
def test_every_imperfection_is_explained(name):
    page = (pathlib.Path(__file__).parents[3] / "docs" / "humans.md").read_text(encoding="utf-8")
    assert f"| `{name}` |" in page
