"""Every registered automation is held to the protocol."""

import numpy as np
import pytest

from cowalk.agents import AUTOMATIONS
from cowalk.agents.automations.planner.settings import NegotiationSettings

ALL = AUTOMATIONS.names()


def play(automation, situation, observe, steps=60):
    automation.reset(np.random.default_rng(0), situation)
    twists = []
    for k in range(steps):
        force = (np.sin(0.3 * k), 3.0 * np.cos(0.11 * k))
        pose = (0.04 * k, 0.3 * np.sin(0.1 * k), 0.1)
        twists.append(automation.act(observe(force=force, pose=pose, time=0.05 * k)))
    return np.array(twists)


@pytest.mark.parametrize("dimensions", ["omega", "both"])
@pytest.mark.parametrize("name", ALL)
def test_twists_are_finite_within_bounds_and_repeatable(name, dimensions, situation, observe):
    def build():
        return AUTOMATIONS.get(name)(negotiation=NegotiationSettings(dimensions=dimensions))

    automation = build()
    first = play(automation, situation, observe)
    assert first.shape == (60, 2)
    assert np.isfinite(first).all()
    assert (first >= np.array(situation.bounds.lower) - 1e-12).all()
    assert (first <= np.array(situation.bounds.upper) + 1e-12).all()
    assert first.tobytes() == play(automation, situation, observe).tobytes()
    assert first.tobytes() == play(build(), situation, observe).tobytes()


@pytest.mark.parametrize("name", ALL)
def test_the_primitive_is_held_between_negotiations(name, situation, observe):
    twists = play(AUTOMATIONS.get(name)(), situation, observe, steps=56)
    changes = np.flatnonzero(np.any(np.diff(twists, axis=0) != 0.0, axis=1)) + 1
    assert set(changes) <= {14, 28, 42}
    assert len(changes) > 0


@pytest.mark.parametrize("name", ALL)
def test_beliefs_are_complete_and_in_range(name, situation, observe):
    automation = AUTOMATIONS.get(name)()
    play(automation, situation, observe)
    belief = automation.belief()
    assert belief.negotiation == 5
    for pair in (belief.stubbornness, belief.human_wish, belief.wish):
        assert pair.shape == (2,)
        assert np.isfinite(pair).all()
    assert 0.0 <= belief.target_utility <= 1.0
    assert belief.target_utility == pytest.approx(1.0 - belief.utility_loss)
    assert ((belief.stubbornness >= 0.0) & (belief.stubbornness <= 1.0)).all()


@pytest.mark.parametrize("dimensions", ["omega", "both"])
@pytest.mark.parametrize("name", ALL)
def test_a_batch_is_as_many_automations(name, dimensions, situation, observe):
    automation = AUTOMATIONS.get(name)(negotiation=NegotiationSettings(dimensions=dimensions))
    rng = np.random.default_rng(2)
    ones = [
        observe(force=rng.normal(scale=3, size=2), pose=(1.0, y, 0.2), twist=(0.7, 0.1))
        for y in (-0.5, 0.0, 0.4)
    ]
    single = []
    for one in ones:
        automation.reset(rng, situation)
        single.append([automation.act(one) for _ in range(30)][-1])
    automation.reset(rng, situation)
    batch = {key: np.stack([one[key] for one in ones]) for key in ones[0]}
    together = [automation.act(batch) for _ in range(30)][-1]
    np.testing.assert_allclose(together, single, atol=1e-9)
