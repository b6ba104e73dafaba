"""stable-baselines3 takes single seats as they are: ``make learn`` runs this."""

import importlib

import pytest

from cowalk.scenarios import scenario_library

pytestmark = pytest.mark.learn


@pytest.mark.parametrize("name", sorted(scenario_library()))
@pytest.mark.parametrize("seat", ["automation", "human"])
def test_its_check_finds_nothing_to_warn_of(name, seat, seat_of):
    checker = importlib.import_module("stable_baselines3.common.env_checker")
    checker.check_env(seat_of(name, seat=seat))  # warnings are errors here


def test_a_policy_learns_from_a_dict_too(seat_of):
    algorithms = importlib.import_module("stable_baselines3")
    env = seat_of(observation="dict")
    model = algorithms.PPO("MultiInputPolicy", env, n_steps=64, batch_size=32, device="cpu")
    model.learn(64)
    observation, _ = env.reset(seed=0)
    assert model.predict(observation)[0] in env.action_space
