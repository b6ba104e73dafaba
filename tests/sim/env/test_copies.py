"""Copied and pickled environments are environments of their own."""

import copy
import pickle

import numpy as np
import pytest

from cowalk.sim import parallel_env
from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.rates import Rates
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.plant.registry import PLANTS
from cowalk.sim.sensor.parameters import SensorParameters

FAULTY = SensorParameters(noise_density=0.01, low_pass=60.0, latency=0.01, drop_rate=0.02)
WHEELS = {"drive": {"kind": "wheels"}}
STRETCHER = {"coupling": {"kind": "stretcher"}, "gait": {"enabled": True}}
COPIED = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda env: pickle.loads(pickle.dumps(env)),
}
every_way = pytest.mark.parametrize("copied", COPIED.values(), ids=COPIED)
every_plant = pytest.mark.parametrize(
    "arguments",
    [*({"plant": name} for name in PLANTS.names()), {"plant_parameters": STRETCHER}],
    ids=[*PLANTS.names(), "stretcher"],
)


@pytest.fixture
def keep():
    """Close every environment that passes through here in the end."""
    kept = []

    def one(env):
        kept.append(env)
        return env

    yield one
    for env in kept:
        env.close()


def walked(env, steps, omega=0.1):
    """Return all that a walk of so many steps gives, as bytes."""
    rows = []
    for step in range(steps):
        force = np.array([1.0, 4.0 * np.sin(0.3 * step)])
        observations, rewards, *_, infos = env.step(
            {"human": force, "automation": np.array([0.7, omega])}
        )
        rows += [part.ravel() for seat in observations.values() for part in seat.values()]
        rows.append(np.array([*rewards.values(), infos["human"]["clearance"]]))
    return np.concatenate(rows).tobytes()


@every_way
@every_plant
def test_a_copy_within_an_episode_goes_on_as_the_original_and_leaves_it_alone(
    arguments, copied, keep
):
    env, undisturbed = (keep(parallel_env(sensor=FAULTY, **arguments)) for _ in range(2))
    for one in (env, undisturbed):
        one.reset(seed=4)
        walked(one, 15)
    other = keep(copied(env))
    assert other.applied == env.applied
    assert other.reward_terms == env.reward_terms
    assert other.plant_state.pose == env.plant_state.pose
    walked(keep(copied(env)), 25, omega=-0.4)
    expected = walked(undisturbed, 10)
    assert walked(other, 10) == expected
    assert walked(env, 10) == expected
    other.close()
    assert walked(env, 5) == walked(undisturbed, 5)
    first, second = (one.reset()[0]["human"] for one in (keep(copied(env)), env))
    assert all(np.array_equal(first[name], second[name]) for name in first)


@every_way
@every_plant
def test_a_copy_before_the_first_reset_starts_as_the_original(arguments, copied, keep):
    env = keep(parallel_env(sensor=FAULTY, duration=5.0, **arguments))
    other = keep(copied(env))
    assert other.steps_per_episode == env.steps_per_episode
    with pytest.raises(SimulationError, match="call reset before step"):
        walked(other, 1)
    for one in (env, other):
        one.reset()
    assert walked(other, 5) == walked(env, 5), "unseeded, they go on from one generator's state"


@every_way
@every_plant
def test_a_copy_of_a_closed_environment_is_closed(arguments, copied):
    env = parallel_env(**arguments)
    env.reset(seed=0)
    walked(env, 2)
    env.close()
    other = copied(env)
    assert other.plant_state.pose == env.plant_state.pose
    with pytest.raises(SimulationError, match="is closed: make a new one"):
        other.reset()


def test_a_copy_of_a_watched_environment_opens_no_window(keep, monkeypatch):
    monkeypatch.setattr("cowalk.sim.view.window.show", lambda picture: None)
    env = keep(parallel_env(plant="unicycle", render_mode="human"))
    env.reset(seed=0)
    assert keep(copy.deepcopy(env)).render_mode is None
    drawn = keep(parallel_env(plant="unicycle", render_mode="rgb_array"))
    drawn.reset(seed=0)
    other = keep(copy.deepcopy(drawn))
    assert np.array_equal(other.render(), drawn.render())


@every_way
def test_on_wheels_a_copy_is_refused_in_one_line_that_says_what_to_do(copied, keep):
    env, undisturbed = (keep(parallel_env(plant_parameters=WHEELS)) for _ in range(2))
    keep(copied(env))
    for one in (env, undisturbed):
        one.reset(seed=4)
        walked(one, 5)
    with pytest.raises(InputError, match="use save and restore in the environment") as refused:
        copied(env)
    assert "\n" not in str(refused.value)
    assert walked(env, 5) == walked(undisturbed, 5)


@every_way
def test_a_plant_of_the_engine_alone_is_not_copied(copied, keep):
    plant = keep(BulletPlant(Rates()))
    with pytest.raises(InputError, match="copy the environment that holds it"):
        copied(plant)


@every_plant
def test_a_saved_state_can_be_pickled(arguments, keep):
    env = keep(parallel_env(sensor=FAULTY, **arguments))
    env.reset(seed=1)
    walked(env, 5)
    saved = pickle.loads(pickle.dumps(env.save()))
    rest = walked(env, 5)
    other = keep(parallel_env(sensor=FAULTY, **arguments))
    other.restore(saved)
    assert walked(other, 5) == rest
