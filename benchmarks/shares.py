"""Where a closed-loop run spends its time, by cProfile (which slows Python, not the engine)."""

from __future__ import annotations

import cProfile
import pstats

from cowalk.scenarios.files.loading import load
from cowalk.scenarios.running.runner import run

GROUPS = {
    "pybullet.stepSimulation": "engine: the step itself",
    "pybullet": "engine: other calls",
    "/sim/bullet_world": "environment: distances",
    "/sim/bullet": "plant: loop, grip, bodies",
    "/sim/walker": "plant: reflexes of the human",
    "/sim/gait": "plant: gait",
    "/sim/drive": "plant: drive",
    "/sim/sensor": "sensor",
    "/sim/env": "environment: step, observations",
    "/sim/eyes": "environment: what is seen",
    "/sim/sight": "environment: what is seen",
    "/sim/clearance": "environment: distances",
    "/sim/path": "paths and poses",
    "/sim/motion": "paths and poses",
    "/sim/": "environment: the rest",
    "/agents/humans": "human",
    "/agents/automations": "automation",
    "/agents/": "agents: the rest",
    "/estimation/": "estimation",
    "/scenarios/": "runner, trace and verdicts",
}


Function = tuple[str, int, str]
Stats = dict[Function, tuple[int, int, float, float, dict[Function, tuple[int, int, float, float]]]]


def _group(function: Function) -> str | None:
    name = f"{function[0]} {function[2]}"
    return next((title for key, title in GROUPS.items() if key in name), None)


def _groups(function: Function, stats: Stats, seen: frozenset[Function]) -> dict[str, float]:
    """Return the groups that a function works for, and its share in each.

    What belongs to none, as NumPy's functions, works for those who call it.
    """
    group = _group(function)
    if group is not None:
        return {group: 1.0}
    callers = {f: t[2] for f, t in stats[function][4].items() if f in stats and f not in seen}
    total = sum(callers.values())
    if total <= 0.0:
        return {"interpreter": 1.0}
    shares: dict[str, float] = {}
    for caller, time in callers.items():
        for title, share in _groups(caller, stats, seen | {function}).items():
            shares[title] = shares.get(title, 0.0) + share * time / total
    return shares


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, share, unit) of the control steps, without building the world."""
    scenario = load("walk").model_copy(update={"duration": 15.0, "expect": {}})
    run(scenario)
    profile = cProfile.Profile()
    profile.enable()
    run(scenario)
    profile.disable()
    stats: Stats = pstats.Stats(profile).stats  # type: ignore[attr-defined]
    ranked: dict[str, float] = {}
    for function, (_, _, own, _, _) in stats.items():
        if any(once in function[2] for once in ("connect", "loadURDF", "resetSimulation")):
            continue
        for title, share in _groups(function, stats, frozenset()).items():
            ranked[title] = ranked.get(title, 0.0) + share * own
    total = sum(ranked.values())
    return [
        (name, 100.0 * t / total, "%") for name, t in sorted(ranked.items(), key=lambda i: -i[1])
    ]
