"""What a run is stepped with: the environment, the agents, what they know, and their seeds."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import require_instance
from cowalk.sim.env.env import CowalkEnv

from ..files.assembling import build_part
from ..files.loading import load
from ..files.schema import Scenario
from .outlines import extent


class Seeds(NamedTuple):
    """Where the randomness of a run comes from: one source a component.

    Attributes
    ----------
    env : int
        For `CowalkEnv.reset`.
    human, automation : numpy.random.Generator
        For their ``reset``.
    """

    env: int
    human: np.random.Generator
    automation: np.random.Generator


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
        start=chosen.start,
        render_mode=render_mode,
    )


def build_agents(scenario: Scenario) -> tuple[Human, Automation]:
    """Return the human and the automation of a scenario, not yet reset.

    Raises
    ------
    InputError
        If a name or a parameter is not right.
    """
    _require_scenario(scenario)
    return build_part(scenario, "human"), build_part(scenario, "automation")


def seeds_of(scenario: Scenario) -> Seeds:
    """Return the seeds of a scenario's components, spawned from its own: always the same.

    Raises
    ------
    InputError
        If it is no scenario.
    """
    _require_scenario(scenario)
    env, human, automation = np.random.SeedSequence(scenario.seed).spawn(3)
    generator = np.random.default_rng
    return Seeds(int(env.generate_state(1)[0]), generator(human), generator(automation))


def situation_of(scenario: Scenario, env: CowalkEnv) -> Situation:
    """Return what both agents know before they start, in an environment that has been reset.

    Raises
    ------
    InputError
        If one of them is of another kind.
    """
    _require_scenario(scenario)
    require_instance("env", env, CowalkEnv, "a CowalkEnv")
    return Situation(
        scenario.world.path,
        scenario.pace,
        scenario.bounds,
        scenario.rates.period,
        extent(env),
        scenario.rates,
    )


def _require_scenario(given: object) -> None:
    require_instance("scenario", given, Scenario, "a Scenario, as load returns one,")
