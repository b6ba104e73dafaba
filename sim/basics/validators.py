"""Parameters given as their dataclass, as plain data from a file, or not at all; and judged."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import fields
from numbers import Real
from typing import Any, TypeVar

import numpy as np

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
        If it is neither, a key is unknown or a value refused.
    """
    if given is None:
        return kind()
    if isinstance(given, kind):
        return given
    known = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    if not isinstance(given, Mapping):
        keys = ", ".join(known)
        raise InputError(f"{name} = {shown(given)}: give a mapping or {kind.__name__} of {keys}")
    if unknown := [str(key) for key in given if key not in known]:
        raise InputError(f"{name}.{unknown[0]}: unknown key; {did_you_mean(unknown[0], known)}")
    try:
        return kind(**given)
    except InputError as error:
        raise InputError(f"{name}.{error}") from error


def shown(value: Any) -> str:
    """Return a value as a message shows it: in one line, and not a long one."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


def is_number(value: Any) -> bool:
    """Return whether a value is a real number: true and false are none."""
    return isinstance(value, Real) and not isinstance(value, bool)


def require_range(name: str, value: Any, within: Range) -> None:
    """Refuse what is no number, or one that makes no sense.

    Raises
    ------
    InputError
        With the name, the value and the range.
    """
    low, high, unit = within
    of = f" {unit}" if unit else ""
    if not is_number(value):
        raise InputError(f"{name} = {shown(value)}: a number is expected{of and f', in{of}'}")
    if not low <= value <= high:
        raise InputError(f"{name} = {value}{of}: must lie between {low:g} and {high:g}{of}")


def require_ranges(given: Any, ranges: Mapping[str, Range]) -> None:
    """Refuse numbers of a dataclass that make no sense; a default always does.

    Raises
    ------
    InputError
        With the name, the value and the range of the first one.
    """
    usual: dict[str, Any] = {item.name: item.default for item in fields(given)}
    for name, within in ranges.items():
        value, default = getattr(given, name), usual[name]
        if value is default or (is_number(value) and value == default):
            continue
        try:
            require_range(name, value, within)
        except InputError as error:
            raise InputError(f"{error}{_or_default(default, within)}") from None


def _or_default(default: Any, within: Range) -> str:
    """Return what else may be given where the default lies outside of the range."""
    if default is None or default == math.inf:
        return ", or be left out"
    inside = not is_number(default) or within[0] <= default <= within[1]
    return "" if inside else f", or be {default:g}"


def require_entries(given: Any, names: Iterable[str], count: int, least: float = -math.inf) -> None:
    """Refuse fields of a dataclass that are not so many finite numbers, of at least some value.

    Lists and arrays become tuples, which can be compared and stay as they are.

    Raises
    ------
    InputError
        With the name and the value of the first one.
    """
    for name in names:
        value = getattr(given, name)
        enough = isinstance(value, tuple | list | np.ndarray) and len(value) == count
        if not (enough and all(is_number(x) and least <= x and math.isfinite(x) for x in value)):
            of = f" of at least {least:g}" if least > -math.inf else ""
            raise InputError(f"{name} = {shown(value)}: must be {count} finite numbers{of}")
        if not isinstance(value, tuple):
            object.__setattr__(given, name, tuple(value))


def require_choices(given: Any, choices: Mapping[str, Collection[str]]) -> None:
    """Refuse fields of a dataclass that are none of the words they can be.

    Raises
    ------
    InputError
        With the name, the value and the words of the first one.
    """
    for name, words in choices.items():
        value = getattr(given, name)
        if not (isinstance(value, str) and value in words):
            raise InputError(f"{name} = {shown(value)}: must be one of {', '.join(words)}")


def require_flag(name: str, value: Any) -> None:
    """Refuse what is neither true nor false.

    Raises
    ------
    InputError
        With the name and the value.
    """
    if not isinstance(value, bool | np.bool_):
        raise InputError(f"{name} = {shown(value)}: true or false is expected")


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
