"""The human seat of a scenario as an object: the model, and its imperfections around it."""

from __future__ import annotations

from cowalk.agents.interfaces import Human, Situation
from cowalk.agents.registry import HUMANS, IMPERFECTIONS
from cowalk.sim.errors import InputError

from .building import attempt
from .documents import Problem
from .schema import HumanComponent, Scenario


def build_human(component: HumanComponent, plant: str) -> Human:
    """Return the human that a section describes, not yet reset.

    Parameters
    ----------
    component : HumanComponent
    plant : str
        Name of the plant, since the body of some makes an imperfection by itself.

    Raises
    ------
    InputError
        If a name or a parameter is not right; the first fault, in one line.
    """
    found = attempt_human(component, plant)
    if isinstance(found, Problem):
        raise InputError(found.message)
    return found


def attempt_human(component: HumanComponent, plant: str) -> Human | Problem:
    """Return the human that a section describes, or the first problem (see `build_human`)."""
    found = attempt(HUMANS, component, "human", intention=component.intention)
    for index, imperfection in enumerate(component.imperfections):
        if isinstance(found, Problem):
            return found
        section = f"human.imperfections.{index}"
        found = attempt(IMPERFECTIONS, imperfection, section, human=found)
        plants = getattr(found, "plants", None)
        if plants is not None and plant not in plants:
            return Problem(
                ("human", "imperfections", index, "name"),
                f"{section}.name = {imperfection.name!r}: it is for the plant "
                f"{' or '.join(plants)}, the body of {plant!r} makes its own; leave it out",
            )
    return found


def situation_of(scenario: Scenario) -> Situation:
    """Return what both agents of a scenario know before they start."""
    return Situation(scenario.world.path, scenario.pace, scenario.bounds, scenario.rates.period)
