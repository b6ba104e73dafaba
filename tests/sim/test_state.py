"""Saving and restoring within an episode, and plants that come and go."""

import gc
import os
from pathlib import Path as File

import numpy as np
import pytest

from cowalk.sim import parallel_env
from cowalk.sim.bullet import BulletPlant
from cowalk.sim.bullet_engine import connect, disconnect
from cowalk.sim.env import STRAIGHT_CORRIDOR
from cowalk.sim.plant import Rates
from cowalk.sim.plants import PLANTS
from cowalk.sim.sensor import SensorParameters

FAULTY = SensorParameters(noise_density=0.01, low_pass=60.0, latency=0.01, drop_rate=0.02)


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
