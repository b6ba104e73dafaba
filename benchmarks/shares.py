"""Where a closed-loop run spends its time, by cProfile (which slows Python, not the engine)."""

from __future__ import annotations

import cProfile
import pstats

from cowalk.scenarios.loading import load
from cowalk.scenarios.runner import run

GROUPS = {
    "pybullet.stepSimulation": "engine: the step itself",
    "pybullet": "engine: other calls",
    "/sim/bullet": "plant: loop, grip, bodies",
    "/sim/walker": "plant: reflexes of the human",
    "/sim/gait": "plant: gait",
    "/sim/drive": "plant: drive",
    "/sim/sensor": "sensor",
    "/sim/": "environment and observations",
    "/agents/": "human and automation",
    "/estimation/": "estimation",
    "/scenarios/": "runner, trace and verdicts",
}


def measure() -> list[tuple[str, float, str]]:
    """Return rows of (what, share, unit), the engine's connecting and loading left out."""
    scenario = load("walk").model_copy(update={"duration": 15.0})
    run(scenario)
    profile = cProfile.Profile()
    profile.enable()
    run(scenario)
    profile.disable()
    shares: dict[str, float] = {}
    for (file, _, function), (_, _, own, _, _) in pstats.Stats(profile).stats.items():  # type: ignore[attr-defined]
        name = f"{file} {function}"
        if any(once in name for once in ("connect", "loadURDF")):
            continue
        group = next((title for key, title in GROUPS.items() if key in name), "numpy and others")
        shares[group] = shares.get(group, 0.0) + own
    total = sum(shares.values())
    ranked = sorted(shares.items(), key=lambda item: -item[1])
    return [(name, 100.0 * own / total, "%") for name, own in ranked]
