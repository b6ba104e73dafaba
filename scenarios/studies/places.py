"""Who walks where in a study: people of a population, each in several worlds."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.world.world import World

from ..files.schema import Scenario
from ..people.person import Person
from ..people.population import Population

WORLDS = 3
"""Walks of each person."""
SHIFT = (1.0, 0.3)
"""How far the obstacles are moved at most from world to world, along x and y, m."""


class Place(NamedTuple):
    """One walk before it is walked.

    Attributes
    ----------
    name : str
        Of the person, unique in the study.
    scenario : Scenario
        In that world, with a seed of its own, which every entry of a comparison shares.
    person : Person
    """

    name: str
    scenario: Scenario
    person: Person


def places(scenario: Scenario, population: Population, people: int) -> list[Place]:
    """Return every person in `WORLDS` worlds; obstacles lie elsewhere in each.

    Raises
    ------
    InputError
        If there are not at least two people.
    """
    if people < 2:
        raise InputError(f"people = {people}: at least 2 are needed", ("people",))
    drawn = population.draw(people, scenario.seed, scenario.plant.name)
    found = []
    for number, person in enumerate(drawn):
        for world in range(WORLDS):
            seed = scenario.seed + WORLDS * number + world
            changes = {"seed": seed, "world": elsewhere(scenario.world, seed), "expect": {}}
            found.append(Place(f"person {number + 1}", scenario.model_copy(update=changes), person))
    return found


def elsewhere(world: World, seed: int) -> World:
    """Return a world with each obstacle moved by a little, drawn from the seed."""
    rng = np.random.default_rng([seed, len(world.obstacles)])
    shifts = rng.uniform(-1.0, 1.0, (len(world.obstacles), 2)) * SHIFT
    obstacles = tuple(
        replace(obstacle, x=obstacle.x + float(dx), y=obstacle.y + float(dy))
        for obstacle, (dx, dy) in zip(world.obstacles, shifts, strict=True)
    )
    return replace(world, obstacles=obstacles)
