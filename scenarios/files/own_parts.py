"""A user's own part, given as ``module:Class``: which kind it is, and what is wrong with it."""

from __future__ import annotations

import inspect
from typing import Any, cast

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import Registry, import_address, marked_kind

from .parts import Part, parts


def own_part_faults(address: str) -> list[str]:
    """Return every fault of a part of one's own, each with its cure.

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
    except Exception as error:  # a user's module may raise anything when imported
        what = f"importing it failed with {type(error).__name__}: {error}"
        raise InputError(f"{address!r}: {what}") from error
    part = kind_of(found)
    if part is None:
        kinds = "; ".join(f"{part.kind}: {', '.join(_registry(part).calls)}" for part in _classes())
        raise InputError(f"{address!r} is no part of any kind; what each needs is {kinds}")
    check = part.own_faults()
    problems = check(found) if check else []
    if not _registry(part).suits(found):
        what = f"taken for a part of the kind {part.kind!r}: "
        problems = [f"{what}{problem}" for problem in problems or [_lacking(part, found)]]
    return [f"{address}: {problem}" for problem in problems]


def kind_of(found: Any) -> Part | None:
    """Return the kind of part that a class, or a marked function, is, or comes nearest to."""
    kinds = _classes()
    if not isinstance(found, type):
        return next((part for part in kinds if part.kind == marked_kind(found)), None)
    suited = [part for part in kinds if _registry(part).suits(found) and _wraps(part, found)]
    if suited:
        return max(suited, key=lambda part: bool(part.wraps))  # the more special kind
    known = {
        part.kind: sum(callable(getattr(found, name, None)) for name in _registry(part).calls)
        / len(_registry(part).calls)
        for part in kinds
    }
    nearest = max(kinds, key=lambda part: known[part.kind])
    return nearest if known[nearest.kind] > 0.0 else None


def _classes() -> list[Part]:
    return [part for part in parts() if not part.preset]


def _registry(part: Part) -> Registry[Any]:
    return cast("Registry[Any]", part.registry())


def _wraps(part: Part, found: type) -> bool:
    return not part.wraps or part.wraps in inspect.signature(found).parameters


def _lacking(part: Part, found: Any) -> str:
    registry = _registry(part)
    methods = ", ".join(
        f"{name} with {count} argument{'' if count == 1 else 's'}"
        for name, count in registry.calls.items()
    )
    return registry.mismatch(found) or f"a {part.kind} is called by {methods}"
