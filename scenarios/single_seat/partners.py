"""Who sits in the other seat: one agent, or one drawn for every episode."""

from __future__ import annotations

from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.seats import SEATS
from cowalk.sim.basics.validators import shown

from ..files.schema import Scenario
from ..people.loading import load_population
from ..people.person import with_person
from ..people.population import Population
from ..running.build import build_agents

SEEDS = 2**32
"""Seeds of episodes and of people are drawn below it."""


class Partners:
    """Agents for a seat of a scenario.

    Parameters
    ----------
    scenario : Scenario
    seat : {"human", "automation"}
        Theirs.
    given : str, agent, sequence of them, or None
        Registered names, ``module:Class``, or agents that are built already, of which copies
        are kept. None is the scenario's own. Another than the scenario's own has the default
        parameters, and what else the scenario's section holds.
    population : str, Path, Population or None
        From which a human is drawn: the name of one that ships, or a file.

    Raises
    ------
    InputError
        If one cannot be built, is no agent, or a population is for the wrong seat.
    """

    def __init__(
        self, scenario: Scenario, seat: str, given: Any, population: str | Path | Population | None
    ) -> None:
        self._scenario, self._seat = scenario, seat
        self._population = self._read(given, population)
        several = list(given) if isinstance(given, list | tuple) else [given]
        if not several:
            raise InputError("partner = []: give at least one to draw from", ("partner",))
        # Built once: an episode begins with their reset.
        self._agents = [] if self._population else [self._one(each) for each in several]

    def _read(self, given: Any, population: Any) -> Population | None:
        if population is None:
            return None
        where = ("population",)
        if self._seat != "human":
            raise InputError(
                f"population = {shown(population)}: people sit in the human seat, and it is "
                "yours; leave it out, or take seat='automation'",
                where,
            )
        if given is not None:
            raise InputError(
                f"population = {shown(population)}: give either a population or a partner", where
            )
        return population if isinstance(population, Population) else load_population(population)

    def draw(self, rng: np.random.Generator) -> tuple[str, Human | Automation]:
        """Return the name and the agent for an episode, not yet reset.

        Parameters
        ----------
        rng : numpy.random.Generator
            The same one draws the same.
        """
        if self._population is None:
            return self._agents[int(rng.integers(len(self._agents)))]
        seed, plant = int(rng.integers(SEEDS)), self._scenario.plant.name
        (person,) = self._population.draw(1, seed, plant)
        section = with_person(self._scenario, person).human
        return section.name, self._built(section)

    def _one(self, given: Any) -> tuple[str, Human | Automation]:
        section = getattr(self._scenario, self._seat)
        if given is None or given == section.name:
            return section.name, self._built(section)
        if isinstance(given, str):
            swapped = section.model_copy(update={"name": given, "parameters": {}})
            return given, self._built(swapped)
        if isinstance(given, type) or not all(hasattr(given, name) for name in ("reset", "act")):
            raise InputError(
                f"partner = {shown(given)}: must be the name of a registered {self._seat}, "
                f"module:Class, an object with reset and act, or a list of these",
                ("partner",),
            )
        # A copy: one may be given to several environments that are stepped in turn.
        return type(given).__name__, deepcopy(given)

    def _built(self, section: Any) -> Human | Automation:
        scenario = self._scenario.model_copy(update={self._seat: section})
        return build_agents(scenario)[SEATS.index(self._seat)]
