"""The human seat of a scenario as an object: the model, and its imperfections around it."""

from __future__ import annotations

from cowalk.agents.basics.protocols import Human
from cowalk.agents.registry import HUMANS, IMPERFECTIONS
from cowalk.sim.basics.errors import InputError

from .building import attempt
from .documents import Fault
from .schema import HumanComponent


def build_human(component: HumanComponent, plant: str, period: float) -> Human:
    """Return the human that a section describes, not yet reset.

    Parameters
    ----------
    component : HumanComponent
    plant : str
        Name of the plant.
    period : float
        Control period, s.

    Raises
    ------
    InputError
        If a name or a parameter is not right; the first fault, in one line.
    """
    found = attempt_human(component, plant, period)
    if isinstance(found, Fault):
        raise InputError(found.message)
    return found


def attempt_human(component: HumanComponent, plant: str, period: float) -> Human | Fault:
    """Return the human that a section describes, or the first problem (see `build_human`)."""
    found: Human | Fault = attempt(HUMANS, component, "human", intention=component.intention)
    for index, imperfection in enumerate(component.imperfections):
        if isinstance(found, Fault):
            break
        section = f"human.imperfections.{index}"
        wrapped = attempt(IMPERFECTIONS, imperfection, section, human=found)
        if not isinstance(wrapped, Fault) and (reason := unsuited(wrapped, plant, period)):
            path = ("human", "imperfections", index, "name")
            wrapped = Fault(path, f"{section}.name = {imperfection.name!r}: {reason}")
        found = wrapped
    return found


def unsuited(imperfection: Human, plant: str, period: float) -> str | None:
    """Return `Imperfection.unsuited`; a user's wrapper need not have it."""
    judge = getattr(imperfection, "unsuited", None)
    return judge(plant, period) if judge else None
