"""Single values of a scenario replaced from outside: ``human.parameters.gain=1.5``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import yaml

from cowalk.sim.basics.errors import InputError

from .documents import KeyPath, Loader, dotted

COMPONENTS: tuple[tuple[str, ...], ...] = (
    ("plant",),
    ("human",),
    ("automation",),
    ("automation", "smoother"),
    ("automation", "observer"),
)
"""Sections that name a replaceable part; outer ones first."""
COMPONENT_LISTS: tuple[tuple[str, ...], ...] = (("human", "imperfections"),)
"""Lists of such sections."""


def component_sections(data: Any) -> Iterator[tuple[Any, KeyPath, Any]]:
    """Yield the parent, the path and the value of every component that data give."""
    for path in (*COMPONENTS, *COMPONENT_LISTS):
        parent = data
        for step in path[:-1]:
            parent = parent.get(step) if isinstance(parent, dict) else None
        if not isinstance(parent, dict) or path[-1] not in parent:
            continue
        value = parent[path[-1]]
        if path in COMPONENTS:
            yield parent, path, value
        elif isinstance(value, list):
            for index, item in enumerate(value):
                yield value, (*path, index), item


def expand_names(data: Any) -> None:
    """Turn every component given by its name alone into a section with a name, in place.

    A sensor given by its name alone becomes a section with a ``preset``.
    """
    if isinstance(data, dict) and isinstance(data.get("sensor"), str):
        data["sensor"] = {"preset": data["sensor"]}
    for parent, path, value in component_sections(data):
        if isinstance(value, str):
            parent[path[-1]] = {"name": value}


def override(data: dict[str, Any], assignment: str) -> KeyPath:
    """Replace one value of plain data in place, and return where it stands.

    A component set to a name alone is swapped: its ``parameters`` go with the old name, what
    else its section holds (``intention``, ``imperfections``, ``negotiation``, ``smoother``,
    ``observer``) stays.

    Parameters
    ----------
    data : dict
        Plain data of a scenario, names expanded.
    assignment : str
        ``dotted.key=VALUE``, the value in YAML; list entries by their index from 0.

    Raises
    ------
    InputError
        If it is no assignment, or the key cannot be there.
    """
    key, equals, text = assignment.partition("=")
    steps = key.strip().split(".")
    if not equals or not all(steps):
        raise InputError(f"--set {assignment}: write KEY=VALUE, such as human.parameters.gain=1.5")
    try:
        value = yaml.load(text, Loader)
    except yaml.YAMLError as error:
        raise InputError(f"--set {assignment}: {text!r} is not a YAML value") from error
    place: Any = data
    path: KeyPath = ()
    for step, following in zip(steps, [*steps[1:], None], strict=True):
        inside, path = _step(place, path, step, assignment)
        if following is None:
            _assign(place, inside, value, tuple(steps))
        elif place[inside] is None:
            place[inside] = {}  # a section left out, all of its keys at their defaults
        place = place[inside]
    return path


def _step(place: Any, path: KeyPath, step: str, assignment: str) -> tuple[Any, KeyPath]:
    """Return the key or index of a step into a container, made ready to be written."""
    where = dotted(path) or "the scenario"
    if isinstance(place, dict):
        place.setdefault(step, None)
        return step, (*path, step)
    if not isinstance(place, list):
        raise InputError(f"--set {assignment}: {where} is {place!r}, there is nothing inside it")
    if not step.isdecimal() or int(step) >= len(place):
        there = f"{len(place)} entries, 0 to {len(place) - 1}" if place else "no entries"
        raise InputError(f"--set {assignment}: {where} has {there}; {step!r} is none of them")
    return int(step), (*path, int(step))


def _assign(place: Any, inside: Any, value: Any, steps: tuple[str, ...]) -> None:
    old = place[inside]
    if steps in COMPONENTS and isinstance(value, str) and isinstance(old, dict):
        kept = {key: item for key, item in old.items() if key != "parameters"}
        place[inside] = kept | {"name": value}
    elif steps == ("sensor",) and isinstance(value, str):
        place[inside] = {"preset": value}
    else:
        place[inside] = value
