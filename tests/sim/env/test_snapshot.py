"""Saving and restoring within an episode, and plants that come and go."""

import gc
import os
from pathlib import Path as File

import numpy as np
import pytest

from cowalk.sim import parallel_env
from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.motion import TwistBounds
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.bullet.plant import BulletPlant
from cowalk.sim.engine.engine import connect, disconnect
from cowalk.sim.env.env import STRAIGHT_CORRIDOR
from cowalk.sim.plant.registry import PLANTS
from cowalk.sim.sensor.sensor import SensorParameters
from cowalk.sim.world.world import World

FAULTY = SensorParameters(noise_density=0.01, low_pass=60.0, latency=0.01, drop_rate=0.02)

ELSEWHERE = World(Path(((0.0, 0.0), (3.0, 3.0))))


@pytest.fixture
def make():
    """Make environments that are closed in the end."""
    made = []

    def one(**arguments):
        made.append(parallel_env(**arguments))
        return made[-1]

    yield one
    for env in made:
        env.close()


def go_on(env, steps):
    rows = []
    for step in range(steps):
        if not env.agents:
            break
        observations, rewards, *_ = env.step(
            {
                "human": np.array([0.0, 4.0 * np.sin(0.3 * step)]),
                "automation": np.array([0.8, 0.1]),
            }
        )
        rows += [part.ravel() for seat in observations.values() for part in seat.values()]
        rows.append(np.array(list(rewards.values())))
    return np.concatenate(rows).tobytes()


@pytest.mark.parametrize("plant", PLANTS.names())
def test_an_environment_goes_on_from_where_it_was_saved(plant):
    env = parallel_env(plant=plant, sensor=FAULTY, duration=4.0)
    env.reset(seed=5)
    go_on(env, 20)
    saved = env.save()
    seen = env.restore(saved)
    assert seen["human"]["time"] == 1.0
    rest = go_on(env, 200)
    assert not env.agents
    env.restore(saved)
    assert env.agents
    assert go_on(env, 200) == rest
    env.restore(saved)
    assert go_on(env, 200) == rest, "a saved state is not used up"
    env.close()


@pytest.mark.parametrize(
    "arguments", [{"plant": "unicycle"}, {"plant": "bullet"}], ids=lambda given: given["plant"]
)
def test_a_state_goes_on_in_another_environment_made_alike(arguments, make):
    env, other = (make(sensor=FAULTY, **arguments) for _ in range(2))
    env.reset(seed=5)
    go_on(env, 5)
    saved = env.save()
    other.restore(saved)
    assert go_on(other, 10) == go_on(env, 10)


@pytest.mark.parametrize(
    ("otherwise", "words"),
    [
        ({"world": ELSEWHERE}, "another world; restore it into the environment that saved it"),
        ({"plant": "unicycle"}, "another plant;"),
        ({"plant_parameters": {"body": {"hand": "both"}}}, "another plant_parameters;"),
        ({"rates": Rates(control=40)}, "another rates;"),
        ({"sensor": FAULTY}, "another sensor;"),
        ({"bounds": TwistBounds(upper=(1.0, 0.5))}, "another bounds;"),
        ({"pace": 0.7}, "another pace;"),
        ({"duration": 20.0}, "another duration;"),
        ({"force_limit": 20.0}, "another force_limit;"),
    ],
    ids=lambda given: next(iter(given)) if isinstance(given, dict) else "",
)
def test_the_state_of_an_environment_made_otherwise_is_refused(otherwise, words, make):
    env, other = make(), make(**otherwise)
    env.reset(seed=0)
    other.reset(seed=0)
    with pytest.raises(InputError, match=words) as refused:
        other.restore(env.save())
    assert "\n" not in str(refused.value)
    with pytest.raises(InputError, match="not a NoneType"):
        other.restore(None)
    assert other.agents
    go_on(other, 2)


def test_on_wheels_a_state_belongs_to_its_environment(make):
    env, other = (make(plant_parameters={"drive": {"kind": "wheels"}}) for _ in range(2))
    env.reset(seed=0)
    other.reset(seed=0)
    go_on(other, 3)
    saved = other.save()
    with pytest.raises(InputError, match="only into the environment that saved it"):
        env.restore(saved)
    rest = go_on(other, 5)
    other.restore(saved)
    assert go_on(other, 5) == rest


def act(env):
    return env.step({"human": np.zeros(2), "automation": np.zeros(2)})


VERBS = {
    "save": lambda env: env.save(),
    "step": act,
    "render": lambda env: env.render(),
    "plant_state": lambda env: env.plant_state,
    "measured_force": lambda env: env.measured_force,
    "sensor_reading": lambda env: env.sensor_reading,
}


@pytest.mark.parametrize("plant", PLANTS.names())
def test_what_needs_a_reset_says_so(plant):
    env = parallel_env(plant=plant, render_mode="rgb_array")
    for name, verb in VERBS.items():
        with pytest.raises(SimulationError, match=f"call reset before {name}"):
            verb(env)
    env.close()


@pytest.mark.parametrize("plant", PLANTS.names())
def test_a_closed_environment_says_so(plant):
    env = parallel_env(plant=plant, render_mode="rgb_array")
    env.reset(seed=0)
    saved = env.save()
    env.close()
    env.close()
    seen = ("plant_state", "measured_force", "sensor_reading")
    verbs = {name: verb for name, verb in VERBS.items() if name not in seen}
    verbs |= {"reset": lambda env: env.reset(), "restore": lambda env: env.restore(saved)}
    for verb in verbs.values():
        with pytest.raises(SimulationError, match="is closed: make a new one"):
            verb(env)
    for name in seen:
        VERBS[name](env)  # what was last seen is still known


def memory():
    """Return the resident memory of this process, bytes."""
    pages = int(File("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not File("/proc/self/statm").exists(), reason="needs Linux's /proc")
@pytest.mark.parametrize(("drive", "cycles"), [("slip", 100), ("wheels", 40)])
def test_plants_that_come_and_go_leave_nothing_behind(drive, cycles):
    """As many as 5 s allow; a thousand are measured by ``python -m benchmarks environments``."""

    def cycle():
        plant = BulletPlant(Rates(), drive={"kind": drive})
        plant.reset(STRAIGHT_CORRIDOR, np.random.default_rng(0))
        plant.step((0.8, 0.0), (0.0, 0.0))
        plant.save()
        plant.close()

    def next_client():
        client = connect()
        disconnect(client)
        return client

    for _ in range(20):
        cycle()
    gc.collect()
    client, before = next_client(), memory()
    for _ in range(cycles):
        cycle()
    gc.collect()
    assert next_client() == client, "every client is used again"
    grown = memory() - before
    assert grown < 2e6, "a plant takes about 1 MB: not one in twenty is left"
