"""What the force sensor costs a control step, beside the bare engine steps of that time."""

from __future__ import annotations

import numpy as np

from cowalk.sim.env.env import parallel_env
from cowalk.sim.sensor.presets import PRESETS
from cowalk.sim.sensor.sensor import ForceSensor, SensorParameters
from cowalk.sim.sensor.wrench import SensorMount

from .timing import best

CALLS = 2000
EVERYTHING = SensorParameters(
    rate=100.0,
    latency=0.01,
    bias=0.1,
    drift=1.0,
    noise_density=0.01,
    low_pass=50.0,
    cross_talk=0.02,
    range=100.0,
    resolution=0.01,
    torque_bias=0.01,
    torque_drift=0.1,
    torque_noise_density=0.001,
    torque_range=100.0,
    torque_resolution=0.001,
    drop_rate=0.01,
    tare=True,
)


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, value, unit)."""
    env = parallel_env()
    env.reset(seed=0)
    rates, plant = env.rates, env._plant
    mount = SensorMount((0.05, 0.0, -0.1), (0.0, 0.0, 0.3))
    load = np.random.default_rng(0).normal(0.0, (5.0, 5.0, 5.0, 0.5, 0.5, 0.5), (rates.samples, 6))

    def bare() -> None:
        for _ in range(CALLS // 10 * rates.substeps):
            plant.bare_step()

    sensors = {"off": SensorParameters(), "everything on": EVERYTHING}
    sensors |= {name: parameters for name, (_, parameters) in PRESETS.items()}
    built = {name: ForceSensor(parameters, rates.sensor) for name, parameters in sensors.items()}
    wall = dict.fromkeys(("bare", *sensors), np.inf)
    for _ in range(5):
        wall["bare"] = min(wall["bare"], best(bare, 1) * 10)
        for name, sensor in built.items():

            def read(sensor: ForceSensor = sensor) -> None:
                for _ in range(CALLS):
                    sensor.measure(load, mount)

            wall[name] = min(wall[name], best(read, 1))
    env.close()
    rows = [("bare engine steps, a control step", wall["bare"] / CALLS * 1e6, "us")]
    for name in sensors:
        rows.append((f"sensor {name}", wall[name] / CALLS * 1e6, "us"))
        rows.append((f"sensor {name}, ratio to bare steps", wall[name] / wall["bare"], "1"))
    return rows
