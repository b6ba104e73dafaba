"""Every registered human model is held to the protocol and to the definition of stubbornness."""

import numpy as np
import pytest

from cowalk.agents import HUMANS

ALL = HUMANS.names()
PRESCRIBED = ("open-loop", "recorded")
"""Whose wish nobody knows."""
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
        assert ((truth.strength > 0.0) & (truth.limit == np.inf)).all()
    return np.array(forces), np.array(truths)


@pytest.mark.parametrize("name", ALL)
def test_force_and_truth_are_finite_and_of_the_right_shape(name, situation, observe, new_human):
    forces, truths = play(new_human(name), situation, observe)
    assert forces.shape == (80, 2)
    assert truths.shape == (80, 4)
    assert np.isfinite(forces).all()
    if name in PRESCRIBED:
        assert np.isnan(truths).all()
    else:
        lower, upper = situation.bounds.lower, situation.bounds.upper
        assert ((truths[:, :2] >= lower) & (truths[:, :2] <= upper)).all()
        assert ((truths[:, 2:] >= 0.0) & (truths[:, 2:] <= 1.0)).all()
    assert np.abs(forces).max() <= 30.0


@pytest.mark.parametrize("name", ALL)
def test_reset_with_the_same_generator_repeats_bit_for_bit(name, situation, observe, new_human):
    human = new_human(name)
    first = play(human, situation, observe)
    again = play(human, situation, observe)
    fresh = play(new_human(name), situation, observe)
    for a, b, c in zip(first, again, fresh, strict=True):
        assert a.tobytes() == b.tobytes() == c.tobytes()


@pytest.mark.parametrize("name", ALL)
def test_global_random_state_is_left_alone(name, situation, observe, new_human):
    before = np.random.get_state()[1].copy()  # noqa: NPY002 - the global state is the subject
    play(new_human(name), situation, observe)
    np.testing.assert_array_equal(before, np.random.get_state()[1])  # noqa: NPY002


@pytest.mark.parametrize("name", ALL)
def test_the_force_answers_the_motion_unless_the_model_says_otherwise(
    name, situation, observe, new_human
):
    human = new_human(name)
    forces, _ = play(human, situation, observe)
    calmer, _ = play(human, situation, observe, gain=0.2)
    assert (forces != calmer).any() == getattr(human, "closed_loop", True)


@pytest.mark.parametrize("name", [name for name in ALL if name not in PRESCRIBED])
def test_force_follows_from_the_truth_by_the_common_definition(name, situation, observe, new_human):
    """Wherever s can be read, and a delay later; in a walk that pulls them in all directions."""
    human = new_human(name)
    human.reset(np.random.default_rng(0), situation)
    rng = np.random.default_rng(1)
    lower, upper = np.array(situation.bounds.lower), np.array(situation.bounds.upper)
    asked, readable = [], []
    for k in range(400):
        twist = rng.uniform(lower, upper)
        pose = (0.04 * k, 0.6 * np.sin(0.05 * k), 0.4 * np.cos(0.03 * k))
        force = human.act(observe(twist=twist, pose=pose, obstacles=PUDDLE, time=0.05 * k))
        truth = human.truth()
        assert ((truth.wish >= lower) & (truth.wish <= upper)).all()
        share = truth.gain * truth.stubbornness * (truth.wish - twist) / upper
        asked.append(truth.strength * np.clip(share, -1.0, 1.0))
        readable.append((truth.stubbornness < 1.0) & (np.abs(share) < 1.0))
        late = k - round(truth.delay / situation.period)
        if late < 0:
            assert (force == 0.0).all()
            continue
        known = readable[late]
        np.testing.assert_allclose(force[known], asked[late][known], atol=1e-9)
        # Beyond s = 1 a force may be larger than the definition says, never smaller.
        assert (np.abs(force) >= np.abs(asked[late]) - 1e-9).all()
    assert np.count_nonzero(readable) > 20


@pytest.mark.parametrize("name", ALL)
def test_a_batch_of_humans_is_as_many_humans(name, situation, observe, new_human):
    human = new_human(name)
    if not getattr(human, "broadcasts", True):
        pytest.skip(f"{name} says that it does not broadcast")
    rng = np.random.default_rng(0)
    lanes = 5
    twists = rng.uniform([0.2, -0.4], [1.0, 0.4], size=(lanes, 2))
    offsets = rng.uniform(-0.5, 0.5, size=lanes)
    steps = 12  # fewer than a turn: what chance decides is not drawn yet
    single = []
    for twist, offset in zip(twists, offsets, strict=True):
        human.reset(np.random.default_rng(0), situation)
        forces = [
            human.act(observe(twist, pose=(k, offset, 0.1), obstacles=PUDDLE, time=0.05 * k))
            for k in range(steps)
        ]
        single.append(np.vstack((forces, human.truth().wish, human.truth().stubbornness)))
    human.reset(np.random.default_rng(0), situation)
    together = []
    for k in range(steps):
        one = observe(obstacles=PUDDLE, time=0.05 * k)
        batch = {key: np.repeat(value[None], lanes, axis=0) for key, value in one.items()}
        batch["pose"] = np.column_stack((np.full(lanes, k), offsets, np.full(lanes, 0.1)))
        together.append(human.act(batch | {"twist": twists}))
    truth = human.truth()
    together += [truth.wish, truth.stubbornness]
    np.testing.assert_allclose(together, np.swapaxes(single, 0, 1), atol=1e-9)
