"""Values of a scenario replaced from outside: ``human.parameters.gain=1.5``, ``human=steady``."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from cowalk.sim.basics.errors import InputError

from ..yaml_text.document import KeyPath, dotted, parse
from .parts import NAME, PARAMETERS, Part, part_at, parts
from .schema import scenario_model
from .validation import known_keys


class OverrideError(InputError):
    """An override is wrong.

    Parameters
    ----------
    assignment : str
        The override as it was given.
    reason : str
        What is wrong with it, in one line.
    number : int
        Which of the overrides it is, from 0.
    """

    def __init__(self, assignment: str, reason: str, number: int = 0) -> None:
        super().__init__(f"{assignment}: {reason}")
        self.assignment, self.reason, self.number = assignment, reason, number

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.assignment, self.reason, self.number)


@dataclass(frozen=True)
class Dropped:
    """What went with the old name when a part was swapped.

    Attributes
    ----------
    section : tuple of str and int
        Where the part is.
    old, new : str
        The names; ``old`` is empty where the values had no name.
    keys : tuple of str
        What the file says of the old part and the new one does not get.
    """

    section: KeyPath
    old: str
    new: str
    keys: tuple[str, ...]

    def __str__(self) -> str:
        of = f" of {self.old!r}" if self.old else ""
        lost = ", ".join(self.keys)
        return f"{dotted(self.section)} is now {self.new!r}: dropped what was said{of}: {lost}"


@dataclass
class Change:
    """What an override did.

    Attributes
    ----------
    path : tuple of str and int
        Where its key is.
    written : list of tuple
        Where it wrote: nowhere if everything was so already.
    dropped : list of Dropped
    """

    path: KeyPath = ()
    written: list[KeyPath] = field(default_factory=list)
    dropped: list[Dropped] = field(default_factory=list)


def sections(data: Any) -> Iterator[tuple[Part, Any, KeyPath, Any]]:
    """Yield the row, the container, the path and the value of every part that data name."""
    for part in parts():
        holder = data
        for step in part.section[:-1]:
            holder = holder.get(step) if isinstance(holder, dict) else None
        if not isinstance(holder, dict) or part.key not in holder:
            continue
        value = holder[part.key]
        if not part.many:
            yield part, holder, part.section, value
        elif isinstance(value, list):
            for index, item in enumerate(value):
                yield part, value, (*part.section, index), item


def expand_names(data: Any) -> None:
    """Turn every part given by its name alone into a section with a name, in place.

    A section without a name gets the one that a scenario without the section has.
    """
    for part, holder, path, value in sections(data):
        if isinstance(value, str):
            holder[path[-1]] = {part.named_by: value}
        elif isinstance(value, dict) and part.default:
            value.setdefault(part.named_by, part.default)


def parsed(assignment: str, number: int = 0) -> tuple[KeyPath, bool, Any]:
    """Return the steps of an assignment's key, whether it replaces all there is, and its value.

    Raises
    ------
    OverrideError
        If it is no assignment.
    """
    key, equals, text = assignment.partition("=")
    whole = key.endswith(":")
    steps = key.removesuffix(":").strip().split(".")
    if not equals or not all(steps):
        raise OverrideError(
            assignment, "write KEY=VALUE, such as human.parameters.gain=1.5", number
        )
    document = parse(text)
    if document.problems:
        shown = repr(text) if len(text) <= _SHOWN else f"{text[:_SHOWN]!r}..."
        reason = f"{shown} is not a YAML value: {document.problems[0].message}"
        raise OverrideError(assignment, reason, number)
    return tuple(steps), whole, document.data


_SHOWN = 60
"""Characters of a value in a message."""


def override(data: dict[str, Any], assignment: str, number: int = 0) -> Change:
    """Replace a value of plain data in place, and return what was done.

    A mapping is merged into a section whose keys are fixed: a part and its ``parameters``,
    ``sensor``, ``negotiation``, an obstacle. Lists, and mappings whose keys the user names
    (``expect``), are replaced; ``KEY={}`` empties a section, ``KEY:=VALUE`` replaces anything.

    A part set to the name that it has stays as it is. Set to another one it is swapped: its
    ``parameters`` go with the old name, what else its section holds (``intention``,
    ``negotiation``, other parts) stays. Of a preset everything goes.

    Parameters
    ----------
    data : dict
        Plain data of a scenario, names expanded.
    assignment : str
        ``dotted.key=VALUE``, the value in YAML; list entries by their index from 0.
    number : int
        Which of the overrides it is, for errors.

    Raises
    ------
    OverrideError
        If it is no assignment, or the key cannot be there.
    """
    steps, whole, value = parsed(assignment, number)
    change = Change()
    place: Any = data
    for step, following in zip(steps, [*steps[1:], None], strict=True):
        try:
            inside, change.path = _step(place, change.path, str(step))
        except InputError as error:
            raise OverrideError(assignment, str(error), number) from error
        if following is None:
            change_in = _replaced if whole else _merged
            place[inside] = change_in(place[inside], value, change.path, change)
        elif place[inside] is None:
            place[inside] = {}  # a section left out, all of its keys at their defaults
        place = place[inside]
    return change


def _step(place: Any, path: KeyPath, step: str) -> tuple[Any, KeyPath]:
    """Return the key or index of a step into a container, made ready to be written."""
    where = dotted(path) or "the scenario"
    if isinstance(place, dict):
        place.setdefault(step, None)
        return step, (*path, step)
    if not isinstance(place, list):
        raise InputError(f"{where} is {place!r}, there is nothing inside it")
    if not step.isdecimal() or int(step) >= len(place):
        there = f"{len(place)} entries, 0 to {len(place) - 1}" if place else "no entries"
        there = "one entry, 0" if len(place) == 1 else there
        raise InputError(f"{where} has {there}; {step!r} is none of them")
    return int(step), (*path, int(step))


def _replaced(old: Any, new: Any, path: KeyPath, change: Change) -> Any:
    change.written.append(path)
    return new


def _merged(old: Any, new: Any, path: KeyPath, change: Change) -> Any:
    """Return a value with another one in its place, or merged into it."""
    part = part_at(path)
    if part is not None and part.preset and new in (None, False):  # as YAML reads "off"
        new = "none"
    if part is not None and isinstance(new, str):
        new = {part.named_by: new}
    both = bool(new) and isinstance(old, dict) and isinstance(new, dict)
    if not (both and _keys_are_fixed(path)):
        if old is None or old != new or type(old) is not type(new):
            change.written.append(path)
        return new
    kept = _without_dropped(part, old, new, path, change) if part is not None else old
    merged = {key: _merged(kept.get(key), new[key], (*path, key), change) for key in new}
    return {**kept, **merged}


def _keys_are_fixed(path: KeyPath) -> bool:
    """Return whether the keys of a section are not for the user to name."""
    for end in range(1, len(path)):
        if path[end] == PARAMETERS and part_at(path[:end]):
            return True  # fixed by the constructor
    return bool(known_keys(scenario_model(), path))


def _without_dropped(
    part: Part, old: dict[str, Any], new: dict[str, Any], path: KeyPath, change: Change
) -> dict[str, Any]:
    """Return a part's section without what goes with its old name, if it gets another one."""
    before = old.get(part.named_by)
    name = new.get(part.named_by, before)
    if name == before or not isinstance(name, str):
        return old
    lost = old if part.preset else (old.get(PARAMETERS) or {})
    keys = tuple(key for key in lost if key != part.named_by)
    if keys:
        change.dropped.append(Dropped(path, before or "", name, keys))
    gone = {*old} if part.preset else {NAME, PARAMETERS}
    return {key: item for key, item in old.items() if key not in gone}
