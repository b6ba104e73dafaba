"""Every registered human model is held to the protocol and to the definition of stubbornness."""

import numpy as np
import pytest

from cowalk.agents import HUMANS

ALL = HUMANS.names()
PUDDLE = ((3.0, -0.7, 0.35),)


def play(human, situation, observe, seed=0, steps=80, gain=1.0):
    """Step a human against a base that turns back and forth; return forces and truths."""
    human.reset(np.random.default_rng(seed), situation)
    forces, truths = [], []
    for k in range(steps):
        twist = (0.6 + 0.2 * gain * np.sin(0.1 * k), 0.2 * gain * np.cos(0.07 * k))
        seen = observe(twist=twist, pose=(0.04 * k, 0.1, 0.0), obstacles=PUDDLE, time=0.05 * k)
        forces.append(human.act(seen))
        truth = human.truth()
        truths.append(np.concatenate((truth.wish, truth.stubbornness)))
    return np.array(forces), np.array(truths)


@pytest.mark.parametrize("name", ALL)
def test_force_and_truth_are_finite_and_of_the_right_shape(name, situation, observe):
    forces, truths = play(HUMANS.get(name)(), situation, observe)
    assert forces.shape == (80, 2)
    assert truths.shape == (80, 4)
    assert np.isfinite(forces).all()
    assert np.isfinite(truths).all()
    assert ((truths[:, 2:] >= 0.0) & (truths[:, 2:] <= 1.0)).all()
    assert np.abs(forces).max() <= 30.0


@pytest.mark.parametrize("name", ALL)
def test_reset_with_the_same_generator_repeats_bit_for_bit(name, situation, observe):
    human = HUMANS.get(name)()
    first = play(human, situation, observe)
    again = play(human, situation, observe)
    fresh = play(HUMANS.get(name)(), situation, observe)
    for a, b, c in zip(first, again, fresh, strict=True):
        assert a.tobytes() == b.tobytes() == c.tobytes()


@pytest.mark.parametrize("name", ALL)
def test_global_random_state_is_left_alone(name, situation, observe):
    before = np.random.get_state()[1].copy()  # noqa: NPY002 - the global state is the subject
    play(HUMANS.get(name)(), situation, observe)
    np.testing.assert_array_equal(before, np.random.get_state()[1])  # noqa: NPY002


@pytest.mark.parametrize("name", ALL)
def test_the_force_answers_the_motion_unless_the_model_says_otherwise(name, situation, observe):
    human = HUMANS.get(name)()
    forces, _ = play(human, situation, observe)
    calmer, _ = play(human, situation, observe, gain=0.2)
    assert (forces != calmer).any() == getattr(human, "closed_loop", True)


@pytest.mark.parametrize("name", ALL)
def test_force_follows_from_the_truth_by_the_common_definition(name, situation, observe):
    human = HUMANS.get(name)()
    human.reset(np.random.default_rng(0), situation)
    for omega in np.linspace(-0.5, 0.5, 21):
        force = human.act(observe(twist=(0.7, omega), obstacles=PUDDLE))
        truth = human.truth()
        missing = (truth.wish - [0.7, omega]) / np.array(situation.bounds.upper)
        expected = 7.5 * np.clip(human.gain * truth.stubbornness * missing, -1.0, 1.0)
        np.testing.assert_allclose(force, expected, atol=1e-12)


@pytest.mark.parametrize("name", ALL)
def test_a_batch_of_humans_is_as_many_humans(name, situation, observe):
    human = HUMANS.get(name)()
    twists = np.random.default_rng(0).uniform([0.2, -0.4], [1.0, 0.4], size=(5, 2))
    single = []
    for twist in twists:
        human.reset(np.random.default_rng(0), situation)
        single.append([human.act(observe(twist=twist, obstacles=PUDDLE)) for _ in range(4)])
    one = observe(obstacles=PUDDLE)
    batch = {key: np.repeat(value[None], 5, axis=0) for key, value in one.items()} | {
        "twist": twists
    }
    human.reset(np.random.default_rng(0), situation)
    together = np.array([human.act(batch) for _ in range(4)])
    np.testing.assert_allclose(together, np.swapaxes(single, 0, 1), atol=1e-12)
