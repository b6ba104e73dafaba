"""Every registered human in every registered imperfection, on both plants."""

import pickle
import random

import numpy as np
import pytest

from cowalk.agents import HUMANS, IMPERFECTIONS
from cowalk.agents.checks.conformance import human_problems
from cowalk.sim.basics.motion import TwistBounds
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.situation import Situation
from cowalk.sim.env.env import CowalkEnv
from cowalk.sim.world.world import Obstacle, World

WORLD = World(
    Path(((0.0, 0.0), (20.0, 0.0))), obstacles=(Obstacle(2.0, -0.7, 0.35, seen_by=("human",)),)
)
BOUNDS = TwistBounds((0.0, -0.5), (1.2, 0.5))
SITUATION = Situation(WORLD.path, 0.8, BOUNDS, Rates().period)
STEPS = 12


@pytest.fixture(scope="module", params=["unicycle", "bullet"])
def env(request):
    made = CowalkEnv(WORLD, plant=request.param, bounds=BOUNDS)
    made.plant_name = request.param
    yield made
    made.close()


def walk(env, human):
    """Return the forces and truths of a short walk in which the base turns to and fro."""
    observations, _ = env.reset(seed=3)
    human.reset(np.random.default_rng(5), SITUATION)
    rows = []
    for step in range(STEPS):
        force = human.act(observations["human"])
        truth = human.truth()
        rows.append(np.concatenate((force, truth.wish, truth.stubbornness)))
        twist = np.array([0.7, 0.3 * np.sin(0.4 * step)])
        observations, *_ = env.step({"human": force, "automation": twist})
    return np.array(rows)


def global_states():
    return pickle.dumps((np.random.get_state(), random.getstate()))  # noqa: NPY002


@pytest.mark.parametrize("imperfection", IMPERFECTIONS.names())
@pytest.mark.parametrize("name", HUMANS.names())
def test_a_walk_is_finite_repeatable_and_true_to_the_human_inside(
    env, name, imperfection, new_human
):
    def make():
        return IMPERFECTIONS.get(imperfection)(new_human(name))

    human = make()
    refused = human.unsuited(env.plant_name, SITUATION.period)
    if imperfection == "gait-ripple" and env.plant_name == "bullet":
        assert "the body makes it" in refused
    else:
        assert refused is None
    before = global_states()
    rows = walk(env, human)
    assert global_states() == before
    assert rows.shape == (STEPS, 6)
    assert np.isfinite(rows[:, :2]).all()
    if name not in ("open-loop", "recorded"):
        assert ((rows[:, 4:] >= 0.0) & (rows[:, 4:] <= 1.0)).all()
    else:
        assert np.isnan(rows[:, 2:]).all()
    truth = human.truth()
    inside = human.human.truth()
    assert truth.wish is inside.wish
    assert truth.stubbornness is inside.stubbornness
    assert truth.strength is inside.strength
    assert truth.delay >= inside.delay
    assert (truth.limit <= inside.limit).all()
    assert walk(env, make()).tobytes() == rows.tobytes()


@pytest.mark.parametrize(
    ("name", "order"), [(name, (-1) ** i) for i, name in enumerate(HUMANS.names())]
)
def test_all_imperfections_at_once_keep_the_protocol_in_either_order(name, order, new_human):
    human = new_human(name)
    for imperfection in IMPERFECTIONS.names()[::order]:
        human = IMPERFECTIONS.get(imperfection)(human)
    assert human_problems(human) == []


@pytest.mark.parametrize("imperfection", IMPERFECTIONS.names())
def test_a_batch_is_as_many_hands(imperfection):
    """Lanes are the same hands as alone, up to the numbers that they draw."""

    class Ramp:
        def reset(self, rng, situation):
            self.step = 0

        def act(self, observation):
            self.step += 1
            return np.broadcast_to(0.5 * self.step, observation["twist"].shape).copy()

        def truth(self):
            raise NotImplementedError

    def play(shape):
        human = IMPERFECTIONS.get(imperfection)(Ramp())
        human.reset(np.random.default_rng(0), SITUATION)
        seen = {"twist": np.full((*shape, 2), 0.8), "force": np.zeros((*shape, 12, 2))}
        return np.array([human.act(seen) for _ in range(STEPS)])

    alone, lanes = play(()), play((6,))
    assert lanes.shape == (STEPS, 6, 2)
    if imperfection in {"tremor", "signal-dependent-noise", "gait-ripple"}:
        assert len(np.unique(lanes[-1, :, 0])) == 6
        assert np.abs(lanes - alone[:, None]).max() < 7.0
    else:
        np.testing.assert_allclose(lanes, np.repeat(alone[:, None], 6, axis=1))
