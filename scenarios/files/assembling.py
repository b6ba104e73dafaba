"""From the sections of a scenario to its parts as objects, each with those beneath it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, cast

from cowalk.agents.basics.protocols import Human
from cowalk.sim.basics.registry import Registry

from ..yaml_text.document import Fault, KeyPath, dotted
from .building import attempt, complete
from .parts import Part, kind_of_part, parts, roots
from .schema import Component, HumanComponent, Scenario, part_of, section_model


@dataclass(frozen=True)
class Surroundings:
    """What a part is told of the scenario around it.

    Attributes
    ----------
    plant : str
        Name of the plant.
    period : float
        Control period, s.
    values : mapping
        What rows of the table take from the top of the scenario (`Part.given`).
    """

    plant: str
    period: float
    values: Mapping[str, Any] = field(default_factory=dict)


def surroundings(scenario: Scenario) -> Surroundings:
    """Return what the parts of a scenario are told of it."""
    values = {key: getattr(scenario, key) for part in roots() for key in part.given}
    return Surroundings(scenario.plant.name, scenario.rates.period, values)


def elsewhere(part: Part, at: KeyPath) -> dict[str, str]:
    """Return which arguments of a part come from elsewhere: where each is set, or nothing.

    Parameters
    ----------
    part : Part
    at : tuple of str and int
        Where its section is.
    """
    places = {name: name for name in part.given} | dict.fromkeys(part.reserved, "")
    places |= {name: dotted((*at, name)) for name in _settings(part)}
    places |= {child.key: dotted((*at, child.key)) for child in part.children() if not child.wraps}
    return places | ({part.wraps: dotted(part.section[:-1])} if part.wraps else {})


def _settings(part: Part) -> list[str]:
    """Return what the section of a part holds besides its name, parameters and other parts."""
    children = {child.key for child in part.children()}
    usual = Component.model_fields
    return [name for name in section_model(part).model_fields if name not in {*usual, *children}]


def build_part(scenario: Scenario, kind: str) -> Any:
    """Return the part of a kind that a scenario names, with those beneath it; not yet reset.

    Parameters
    ----------
    scenario : Scenario
    kind : str
        As in the table of parts: ``"human"``, ``"automation"``, ...

    Raises
    ------
    InputError
        If a name or a parameter is not right; the first fault, in one line.
    """
    return _built(kind, part_of(scenario, kind), surroundings(scenario))


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
    return cast(Human, _built("human", component, Surroundings(plant, period)))


def _built(kind: str, component: Component, around: Surroundings) -> Any:
    part = kind_of_part(kind)
    faults: list[Fault] = []
    made = assemble(part, component, around, part.section, faults)
    if faults:
        raise faults[0].error()
    return made


def assemble(
    part: Part,
    component: Component,
    around: Surroundings,
    at: KeyPath,
    faults: list[Fault],
    inside: Any = None,
) -> Any:
    """Return a part as an object, those beneath it first; None with the reasons in ``faults``.

    Parameters
    ----------
    part : Part
    component : Component
        Its section.
    around : Surroundings
    at : tuple of str and int
        Where the section is.
    faults : list of Fault
        What is wrong is added here.
    inside : object
        What it is built around, if it is of a kind that wraps.
    """
    before = len(faults)
    shared = {key: value for key, value in around.values.items() if key in part.given}
    shared |= {name: getattr(component, name) for name in _settings(part)}
    if part.wraps:
        shared[part.wraps] = inside
    around_it: list[tuple[Part, Component, KeyPath]] = []
    for child in part.children():
        beneath: KeyPath = (*at, child.key)
        section = getattr(component, child.key)
        if child.wraps:
            around_it += [(child, item, (*beneath, i)) for i, item in enumerate(section)]
        elif child.many:
            shared[child.key] = tuple(
                assemble(child, item, around, (*beneath, index), faults)
                for index, item in enumerate(section)
            )
        else:
            shared[child.key] = assemble(child, section, around, beneath, faults)
    if faults[before:]:
        return None
    made = attempt(_registry(part), component, at, shared, elsewhere(part, at))
    if not isinstance(made, Fault) and (reason := unsuited(made, around.plant, around.period)):
        named: KeyPath = (*at, "name")
        made = Fault(named, f"{dotted(named)} = {component.name!r}: {reason}")
    if isinstance(made, Fault):
        faults.append(made)
        return None
    for child, item, beneath in around_it:
        made = assemble(child, item, around, beneath, faults, made)
        if made is None:
            break
    return made


def _registry(part: Part) -> Registry[Any]:
    return cast("Registry[Any]", part.registry())


def unsuited(made: Any, plant: str, period: float) -> str | None:
    """Return why a part says that it cannot be used with a plant or at a control period.

    Only a class that minds has such a method (see `Imperfection.unsuited`).
    """
    judge = getattr(made, "unsuited", None)
    return judge(plant, period) if judge else None


def resolve(scenario: Scenario) -> Scenario:
    """Return the scenario with the default parameters of its parts written out.

    A file of it gives the same run even after a default has changed.
    """
    resolved = {part.key: _resolved(part, getattr(scenario, part.key)) for part in roots()}
    return scenario.model_copy(update=resolved)


def _resolved(part: Part, component: Component) -> Component:
    """Return a section with the default parameters of its part, and of those beneath it."""
    update: dict[str, Any] = {}
    for child in part.children():
        section = getattr(component, child.key)
        if child.many:
            update[child.key] = tuple(_resolved(child, item) for item in section)
        else:
            update[child.key] = _resolved(child, section)
    taken = elsewhere(part, part.section)
    update["parameters"] = complete(_registry(part), component, taken)
    return component.model_copy(update=update)


def named_parts(scenario: Scenario) -> dict[str, Any]:
    """Return the name of every part of a scenario, for a summary; a list where there are many."""
    found: dict[str, Any] = {}
    for part in parts():
        value: Any = scenario
        for step in part.section:
            value = getattr(value, step)
        if part.many:
            found[part.title] = [item.name for item in value]
        elif part.preset:
            names = part.registry().names()
            same = [name for name in names if part.registry().get(name) == value]
            found[part.title] = (same or ["none" if value == type(value)() else "own values"])[0]
        else:
            found[part.title] = value.name
    return found


def said_parts(scenario: Scenario) -> str:
    """Return seed and parts of a scenario in one line, without those that are off."""
    said = [f"seed {scenario.seed}"]
    for title, names in named_parts(scenario).items():
        names = ", ".join(names) if isinstance(names, list) else names
        if names not in ("", "none"):
            said.append(f"{title} {names}")
    return "; ".join(said)
