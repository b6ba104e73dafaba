"""People and automations that do their worst, for long: nothing diverges, tunnels or leaks.

A few in the default suite, a thousand by ``make soak``.
"""

import gc
import math

import numpy as np
import psutil
import pytest

from cowalk.scenarios import load, make_env

STEPS = 80
"""At most, 4 s of walking."""
REASONS = ("goal", "collision", "grip_lost")
WAYS = ("bang-bang", "noise", "push", "spin", "resonant", "nothing")


def adversary(rng, low, high, way):
    """Return a function of the step: an action within its space, as unkind as can be."""
    low, high = (np.clip(np.asarray(end, dtype=float), -1e3, 1e3) for end in (low, high))
    held = rng.choice([0, 1], size=2)
    period = int(rng.integers(1, 12))

    def act(step):
        if way == "bang-bang":
            return np.where((held + step // period) % 2, high, low)
        if way == "noise":
            return rng.uniform(low, high)
        if way == "push":
            return np.where(held, high, low)
        if way == "spin":
            return np.array([0.0, high[1] if held[1] else low[1]])
        if way == "resonant":
            return 0.5 * (low + high) + 0.5 * (high - low) * math.sin(2 * math.pi * step / period)
        return np.zeros(2)

    return act


def walk(number):
    """Walk through one adversarial case; return what is wrong with it, or nothing."""
    rng = np.random.default_rng(number)
    things = [
        {"kind": "pillar", "x": float(rng.uniform(1.2, 6.0)), "y": float(rng.uniform(-1.5, 1.5))}
        | {"radius": float(rng.uniform(0.02, 0.3))}
        for _ in range(int(rng.integers(0, 4)))
    ]
    scenario = load(
        "puddle",
        [
            f"world.obstacles={things}",
            f"world.corridor.width={rng.uniform(2.6, 5.0)}",
            f"force_limit={rng.choice([30.0, 100.0, 300.0])}",
            "bounds.upper=[1.5, 1.5]",
            "bounds.lower=[0.0, -1.5]",
            f"seed={number}",
            "expect={}",
            f"duration={STEPS / 20}",
        ],
    )
    env = make_env(scenario)
    try:
        env.reset(seed=number)
        acts = {
            seat: adversary(rng, space.low, space.high, str(rng.choice(WAYS)))
            for seat, space in ((seat, env.action_space(seat)) for seat in env.agents)
        }
        half, before, info = scenario.world.corridor.width / 2.0, np.array(env.plant_state.pose), {}
        for step in range(2 * STEPS):
            if not env.agents:
                break
            actions = {
                seat: np.asarray(act(step), dtype=env.action_space(seat).dtype)
                for seat, act in acts.items()
            }
            _, rewards, _, cut, infos = env.step(actions)
            state, info = env.plant_state, infos["human"]
            for name in ("pose", "twist", "human_pose", "wrench_on_base"):
                if not np.isfinite(getattr(state, name)).all():
                    return f"{name} is not finite in step {step}"
            if not np.isfinite(list(rewards.values())).all():
                return f"rewards are not finite in step {step}"
            now = np.array(state.pose)
            if np.hypot(*(now - before)[:2]) > 5.0 / 20 or np.abs(state.twist).max() > 20.0:
                return f"the base jumps from {before} to {now} in step {step}"
            for body in (state.pose, state.human_pose):
                if abs(body[1]) > half and not info["collision"]:
                    return f"through a wall in step {step}"
            for thing in things:
                if reach(before, now, thing) < thing["radius"] and not info["collision"]:
                    return f"through a pillar in step {step}"
            before = now
        if env.agents:
            return f"not over after {2 * STEPS} steps"
        if not (any(info.get(why) for why in REASONS) or any(cut.values()) or state.end):
            return "ended without a reason"
    finally:
        env.close()
    return ""


def reach(start, end, thing):
    """Return how near the middle of the base comes to the middle of a thing between two poses."""
    way = end[:2] - start[:2]
    centre = np.array([thing["x"], thing["y"]]) - start[:2]
    share = np.clip(centre @ way / max(1e-12, way @ way), 0.0, 1.0)
    return float(np.hypot(*(centre - share * way)))


def wrong_with(numbers):
    return {number: fault for number in numbers if (fault := walk(number))}


def memory():
    gc.collect()
    return psutil.Process().memory_info().rss / 1e6


def growth(environments, steps):
    """Return by how many MB the process grows over environments, and over steps, once warm."""
    scenario = load("puddle", ["expect={}", "duration=86400"])

    def make():
        env = make_env(scenario)
        env.reset(seed=0)
        return env

    for _ in range(10):
        make().close()
    before = memory()
    for _ in range(environments):
        make().close()
    made = memory() - before
    env = make()
    actions = {seat: np.zeros(2, dtype=env.action_space(seat).dtype) for seat in env.agents}
    for _ in range(200):
        env.step(actions)
    before = memory()
    for _ in range(steps):
        if not env.agents:
            env.reset(seed=0)
        env.step(actions)
    walked = memory() - before
    env.close()
    return made, walked


def test_a_few_adversaries_break_nothing():
    assert wrong_with(range(12)) == {}


def test_a_tunnel_would_be_seen():
    thing = {"x": 1.0, "y": 0.0, "radius": 0.1}
    assert reach(np.array([0.0, 0.05, 0.0]), np.array([2.0, 0.05, 0.0]), thing) < 0.1
    assert reach(np.array([0.0, 0.2, 0.0]), np.array([2.0, 0.2, 0.0]), thing) > 0.1


def test_memory_stays_flat_over_a_few_environments_and_steps():
    made, walked = growth(30, 3000)
    assert made < 3.0
    assert walked < 3.0


@pytest.mark.soak
def test_a_thousand_adversaries_break_nothing():
    assert wrong_with(range(1000)) == {}


@pytest.mark.soak
def test_memory_stays_flat_over_500_environments_and_100_000_steps():
    made, walked = growth(500, 100_000)
    print(f"grew by {made:.1f} MB over 500 environments, {walked:.1f} MB over 100,000 steps")
    assert made < 10.0
    assert walked < 10.0
