"""Parameters given as their dataclass, as plain data from a file, or not at all; and judged."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import fields
from typing import Any, TypeVar

from .errors import InputError
from .registry import did_you_mean

P = TypeVar("P")
Range = tuple[float, float, str]
"""Least and largest sensible value, and the unit."""


def parameters(name: str, kind: type[P], given: Any) -> P:
    """Return parameters as their dataclass.

    Parameters
    ----------
    name : str
        What messages call them.
    kind : type
        The dataclass.
    given : dataclass, mapping or None

    Raises
    ------
    InputError
        If a key is unknown or a value refused.
    """
    if given is None:
        return kind()
    if not isinstance(given, Mapping):
        return given  # type: ignore[no-any-return]
    known = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    if unknown := [key for key in given if key not in known]:
        raise InputError(f"{name}.{unknown[0]}: unknown key; {did_you_mean(unknown[0], known)}")
    values = {key: tuple(v) if isinstance(v, list) else v for key, v in given.items()}
    try:
        return kind(**values)
    except InputError as error:
        raise InputError(f"{name}.{error}") from error


def require_ranges(given: Any, ranges: Mapping[str, Range]) -> None:
    """Refuse numbers of a dataclass that make no sense.

    Raises
    ------
    InputError
        With the name, the value and the range of the first one.
    """
    for name, (low, high, unit) in ranges.items():
        value = getattr(given, name)
        if not low <= value <= high:
            of = f" {unit}" if unit else ""
            raise InputError(f"{name} = {value}{of}: must lie between {low:g} and {high:g}{of}")


def require_effect(given: Any, kinds: Mapping[str, Collection[str]]) -> None:
    """Refuse values of a dataclass that do nothing with its ``kind``.

    Parameters
    ----------
    given : dataclass
    kinds : mapping of str to collection of str
        Names that have an effect only with each kind. Left at its default, a name passes.

    Raises
    ------
    InputError
        With the name and the kind that it belongs to.
    """
    usual = {item.name: item.default for item in fields(given)}
    for kind, names in kinds.items():
        for name in names if kind != given.kind else ():
            value = getattr(given, name)
            if value != usual[name]:
                raise InputError(
                    f"{name} = {value}: has no effect with kind = {given.kind!r}, only with "
                    f"{kind!r}; leave it out"
                )
