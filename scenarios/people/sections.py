"""Sections of plain data in which a distribution may stand for a number."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from copy import deepcopy
from typing import Any

from ..files.validation import validate
from ..yaml_text.document import Fault, KeyPath, dotted
from .distribution import KEY, Distribution


def nodes(value: Any, path: KeyPath = ()) -> Iterator[tuple[KeyPath, dict[str, Any]]]:
    """Yield the path and the content of every distribution, in the order of the file."""
    if isinstance(value, dict) and KEY in value:
        yield path, value
    elif isinstance(value, dict | list):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from nodes(item, (*path, key))


def distributions(section: Any) -> dict[KeyPath, Distribution]:
    """Return every distribution of a section by its path; they are known to be right."""
    return {path: Distribution(**value) for path, value in nodes(section)}


def filled(section: dict[str, Any], values: Mapping[KeyPath, float]) -> dict[str, Any]:
    """Return a copy of a section with values in the places of its distributions."""
    copied = deepcopy(section)
    for path, value in values.items():
        place: Any = copied
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = value
    return copied


def read_distributions(
    section: Any, at: KeyPath
) -> tuple[dict[KeyPath, Distribution], list[Fault]]:
    """Return the distributions of a section, and what is wrong with them.

    Parameters
    ----------
    section : object
        Plain data.
    at : tuple of str and int
        Where it stands, for messages.
    """
    laws: dict[KeyPath, Distribution] = {}
    faults: list[Fault] = []
    for path, node in nodes(section):
        if path[-1:] in ((), ("name",)):
            what = (
                "a name is no number to draw; for several models, give each a group with a weight"
            )
            faults.append(Fault((*at, *path), f"{dotted((*at, *path))}: {what}"))
            continue
        law, found = validate(Distribution, node, (*at, *path))
        faults += found
        if law is not None:
            laws[path] = law
    return laws, faults


def try_ends(
    section: dict[str, Any],
    laws: Mapping[KeyPath, Distribution],
    at: KeyPath,
    judge: Callable[[dict[str, Any]], list[Fault]],
) -> list[Fault]:
    """Return what is wrong where one distribution is at an end, the others at their medians.

    Parameters
    ----------
    section, laws, at
        See `read_distributions`.
    judge : callable
        Returns what is wrong with a filled section.
    """
    medians = {path: law.at(0.5) for path, law in laws.items()}
    trials: list[tuple[KeyPath, dict[KeyPath, float]]] = [((), medians)]
    trials += [(path, medians | {path: end}) for path, law in laws.items() for end in law.ends]
    for path, values in trials:
        if found := judge(filled(section, values)):
            return [Fault((*at, *path) if path else found[0].path, found[0].message)]
    return []
