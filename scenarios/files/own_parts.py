"""A user's own part, given as ``module:Class``: which kind it is, and what is wrong with it."""

from __future__ import annotations

import inspect
from typing import Any, NamedTuple, cast

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import Registry, import_address, marked_kind, takes

from ..trace.columns import all_columns
from .parts import Part, parts


class OwnPart(NamedTuple):
    """A part of one's own, judged.

    Attributes
    ----------
    kind : str
    faults : list of str
        Each with its cure.
    """

    kind: str
    faults: list[str]


def judge_own_part(address: str) -> OwnPart:
    """Return which kind of part it is that a user has written, and every fault of it.

    Parameters
    ----------
    address : str
        ``module:Class``, or a function that is marked as a part.

    Raises
    ------
    InputError
        If it cannot be imported, or is no part of any kind.
    """
    try:
        found = import_address(address)
    except InputError as error:
        raise InputError(f"{address!r} {error}") from error
    part = kind_of(found)
    if part is None:
        kinds = "; ".join(f"{part.kind}: {', '.join(_registry(part).calls)}" for part in _classes())
        raise InputError(f"{address!r} is no part of any kind; what each needs is {kinds}")
    check = part.own_faults()
    problems = check(found) if check else []
    problems += _column_faults(found)
    whose = f"{address} ({part.kind})"
    if not _registry(part).suits(found):
        whose = f"{address}: taken for a part of the kind {part.kind!r}"
        problems = problems or [_lacking(part, found)]
    return OwnPart(part.kind, [f"{whose}: {problem}" for problem in problems])


def kind_of(found: Any) -> Part | None:
    """Return the kind of part that a class, or a marked function, is, or comes nearest to."""
    kinds = _classes()
    if not isinstance(found, type):
        return next((part for part in kinds if part.kind == marked_kind(found)), None)
    suited = [part for part in kinds if _registry(part).suits(found) and _wraps(part, found)]
    if suited:
        return max(suited, key=lambda part: bool(part.wraps))  # the more special kind
    nearest = max(kinds, key=lambda part: _likeness(part, found))
    return nearest if _likeness(nearest, found)[0] else None


def _likeness(part: Part, found: type) -> tuple[int, ...]:
    """Return how many methods of a kind of part a class has, takes as called, and names alike."""
    calls = _registry(part).calls
    methods = {name: getattr(found, name) for name in calls if callable(getattr(found, name, None))}
    taken = sum(takes(method, len(calls[name])) for name, method in methods.items())
    named = [set(calls[name]) & _arguments(method) for name, method in methods.items()]
    return len(methods), taken, sum(map(len, named))


def _arguments(method: Any) -> set[str]:
    try:
        return set(inspect.signature(method).parameters)
    except ValueError:  # compiled: nothing is known of it
        return set()


def _column_faults(found: Any) -> list[str]:
    """Return why a trace cannot take the columns that a class declares."""
    columns = getattr(found, "columns", None)
    try:
        all_columns(columns if isinstance(columns, dict) else {})
    except InputError as error:
        return [str(error)]
    return []


def _classes() -> list[Part]:
    return [part for part in parts() if not part.preset]


def _registry(part: Part) -> Registry[Any]:
    return cast("Registry[Any]", part.registry())


def _wraps(part: Part, found: type) -> bool:
    return not part.wraps or part.wraps in inspect.signature(found).parameters


def _lacking(part: Part, found: Any) -> str:
    registry = _registry(part)
    methods = ", ".join(
        f"{name}({', '.join(arguments)})" for name, arguments in registry.calls.items()
    )
    return registry.mismatch(found) or f"a {part.kind} is called by {methods}"
