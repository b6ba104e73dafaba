"""From the sensor's reading to the twist, a negotiation passes the rooms that the map shows."""

import re
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from cowalk.scenarios import load
from cowalk.scenarios.running.build import build_agents, make_env, seeds_of, situation_of

ROOT = Path(__file__).parent.parent
PARTS = ("sim", "estimation", "agents", "scenarios")


def on_the_map():
    """Return the numbered rooms of ARCHITECTURE.md's picture."""
    _, _, rest = (ROOT / "ARCHITECTURE.md").read_text().partition("<!-- one negotiation -->")
    _, picture, _ = rest.split("```", 2)
    return re.findall(rf"^ *\d+  ((?:{'|'.join(PARTS)})/[a-z_/]+)", picture, re.MULTILINE)


@contextmanager
def profiled(note):
    sys.setprofile(note)
    try:
        yield
    finally:
        sys.setprofile(None)


def passed(plant):
    """Return the rooms called from the second negotiation's reading on, in the order they are."""
    scenario = load("puddle", [f"plant={plant}"])
    human, automation = build_agents(scenario)
    env = make_env(scenario)
    seeds = seeds_of(scenario)
    observations, _ = env.reset(seed=seeds.env)
    situation = situation_of(scenario, env)
    human.reset(seeds.human, situation)
    automation.reset(seeds.automation, situation)
    calls = []

    def note(frame, event, _):
        if event == "call":
            calls.append((frame.f_code.co_filename, frame.f_code.co_qualname))

    for _ in range(scenario.automation.negotiation.steps(situation.period)):
        actions = {
            "human": human.act(observations["human"]),
            "automation": automation.act(observations["automation"]),
        }
        calls.clear()
        with profiled(note):
            observations, *_ = env.step(actions)
    before = automation.belief().negotiation
    with profiled(note):
        automation.act(observations["automation"])
    env.close()
    assert automation.belief().negotiation == before + 1
    measured = next(i for i, (_, name) in enumerate(calls) if name == "ForceSensor.measure")
    rooms = (Path(file).relative_to(ROOT).parent for file, _ in calls[measured:] if ours(file))
    return list(dict.fromkeys(room.as_posix() for room in rooms))


def ours(file):
    path = Path(file)
    return path.is_relative_to(ROOT) and path.relative_to(ROOT).parts[0] in PARTS


@pytest.mark.parametrize("plant", ["bullet", "unicycle"])
def test_a_negotiation_passes_the_rooms_of_the_map_in_their_order(plant):
    assert passed(plant) == on_the_map()


def test_a_negotiation_passes_few_rooms():
    assert len(on_the_map()) <= 10
