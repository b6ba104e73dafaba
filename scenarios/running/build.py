"""The environment and the agents of a scenario."""

from __future__ import annotations

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.env.env import CowalkEnv

from ..files.assembling import build_part
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
    return build_part(scenario, "human"), build_part(scenario, "automation")
