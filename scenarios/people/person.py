"""One person: how they decide, and the body that they walk with."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from cowalk.sim.basics.validators import require_instance
from cowalk.sim.plant.registry import PLANTS

from ..files.building import parameter_names
from ..files.schema import HumanComponent, Scenario


@dataclasses.dataclass(frozen=True)
class Person:
    """A whole person, drawn from a population.

    Attributes
    ----------
    human : HumanComponent
        The human section of a scenario: model, strength, intention, imperfections.
    plant : dict of str to dict
        Parameters of a plant that has bodies, by section: ``body`` (height m, mass kg),
        ``gait`` (sway m, step frequency Hz), ``walker`` (the arm's stiffness N/m and damping
        N s/m). Empty where the population says nothing of them.
    kind : str
        What the population calls people of their build.
    """

    human: HumanComponent
    plant: dict[str, dict[str, Any]] = dataclasses.field(default_factory=dict)
    kind: str = ""


def with_person(scenario: Scenario, person: Person) -> Scenario:
    """Return the scenario in which a person walks.

    How they like to walk is their own, where they want to go the scenario's: its
    ``intention.path`` and ``intention.changes`` stay unless the person has their own. What a
    person has of body, gait and arm wins over the scenario's ``plant.parameters``; what they do
    not have, such as ``body.hand``, stays. A plant without bodies takes none of it.

    Parameters
    ----------
    scenario : Scenario
    person : Person
        Drawn for the scenario's plant.

    Raises
    ------
    InputError
        If one of them is of another kind, or the plant is unknown.
    """
    require_instance("scenario", scenario, Scenario, "a Scenario, as load returns one,")
    require_instance("person", person, Person, "a Person, as Population.draw returns them,")
    wanted = scenario.human.intention
    if "intention" in person.human.model_fields_set:
        own = person.human.intention
        path, changes = own.path or wanted.path, own.changes or wanted.changes
        wanted = dataclasses.replace(own, path=path, changes=changes)
    taken = takes(scenario.plant.name)
    parameters = dict(scenario.plant.parameters)
    for name, values in person.plant.items():
        if name in taken:
            parameters[name] = _plain(parameters.get(name, {})) | values
    return scenario.model_copy(
        update={
            "human": person.human.model_copy(update={"intention": wanted}),
            "plant": scenario.plant.model_copy(update={"parameters": parameters}),
        }
    )


def takes(plant: str) -> frozenset[str]:
    """Return the parameters of a plant, by its name.

    Raises
    ------
    InputError
        If it is unknown.
    """
    return frozenset(parameter_names(PLANTS.get(plant)))


def _plain(section: Any) -> dict[str, Any]:
    return dict(section) if isinstance(section, Mapping) else dataclasses.asdict(section)
