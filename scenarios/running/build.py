"""The environment and the agents of a scenario."""

from __future__ import annotations

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.agents.registry import AUTOMATIONS
from cowalk.estimation.registry import OBSERVERS, SMOOTHERS
from cowalk.sim.env.env import CowalkEnv

from ..files.building import build
from ..files.human_seat import build_human
from ..files.loading import load
from ..files.schema import Scenario


def make_env(scenario: str | Scenario, render_mode: str | None = None) -> CowalkEnv:
    """Return the environment of a scenario: its world, plant, rates, sensor and bounds.

    Parameters
    ----------
    scenario : str or Scenario
        Name, file or loaded scenario.
    render_mode : {None, "rgb_array", "human"}

    Raises
    ------
    InputError
        If the scenario or its plant is not right.
    """
    chosen = scenario if isinstance(scenario, Scenario) else load(scenario)
    return CowalkEnv(
        chosen.world,
        plant=chosen.plant.name,
        plant_parameters=chosen.plant.parameters,
        rates=chosen.rates,
        sensor=chosen.sensor,
        bounds=chosen.bounds,
        pace=chosen.pace,
        duration=chosen.duration,
        force_limit=chosen.force_limit,
        reward=chosen.reward,
        render_mode=render_mode,
    )


def build_agents(scenario: Scenario) -> tuple[Human, Automation]:
    """Return the human and the automation of a scenario, not yet reset.

    Raises
    ------
    InputError
        If a name or a parameter is not right.
    """
    human = build_human(scenario.human, scenario.plant.name, scenario.rates.period)
    seat = scenario.automation
    automation = build(
        AUTOMATIONS,
        seat,
        "automation",
        negotiation=seat.negotiation,
        smoother=build(SMOOTHERS, seat.smoother, "automation.smoother"),
        observer=build(OBSERVERS, seat.observer, "automation.observer"),
    )
    return human, automation
