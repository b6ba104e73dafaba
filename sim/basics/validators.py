"""Validators: nonsense is refused at the door, with what would be right.

Every one raises `InputError` whose message begins with the place and whose ``at`` is that place.
Lists are judged in `cowalk.sim.basics.lists`, parameters in `cowalk.sim.basics.parameters`.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import fields
from numbers import Integral, Real
from typing import Any, TypeGuard

import numpy as np

from .errors import InputError, Step

Range = tuple[float, float, str]
"""Least and largest sensible value, and the unit."""
Place = Step | tuple[Step, ...]
"""Name of what is judged, or the way to it from what holds it."""

SHARE: Range = (0.0, 1.0, "")


def shown(value: Any) -> str:
    """Return a value as a message shows it: in one line, and not a long one."""
    try:
        text = " ".join((str if is_number(value) else repr)(value).split())
    except Exception:  # a user's class may raise anything, and a number have too many digits
        text = f"a {type(value).__name__}"
    return text if len(text) <= 60 else f"{text[:57]}..."


def said(value: Any) -> str:
    """Return in a few words what a part answered: of an array its shape, else as `shown`."""
    if not isinstance(value, np.ndarray):
        return shown(value)
    of = "" if value.dtype.kind in "fiub" else f" of {value.dtype}"
    return f"an array{of} of shape {value.shape}"


def is_number(value: Any) -> bool:
    """Return whether a value is a real number: true and false are none."""
    return isinstance(value, Real) and not isinstance(value, bool)


def refusal(place: Place, value: Any, what: str, unit: str = "") -> InputError:
    """Return the error of one value: ``place = value unit: what``."""
    at = place if isinstance(place, tuple) else (place,)
    of = f" {unit}" if unit and is_number(value) else ""
    return InputError(f"{'.'.join(map(str, at))} = {shown(value)}{of}: {what}", at)


def require(holds: bool, place: Place, value: Any, what: str, unit: str = "") -> None:
    """Refuse a value unless a condition holds.

    Raises
    ------
    InputError
        With the place, the value and ``what`` it must be.
    """
    if not holds:
        raise refusal(place, value, what, unit)


def require_range(place: Place, value: Any, within: Range, lanes: bool = False) -> None:
    """Refuse what is no number, or one that makes no sense.

    Parameters
    ----------
    place : str, int or tuple of them
    value : object
    within : Range
    lanes : bool
        Whether an array may be given, a number for each of a batch.

    Raises
    ------
    InputError
        With the place, the value and the range.
    """
    unit = within[2]
    if not (is_number(value) or (lanes and is_array(value))):
        raise refusal(place, value, f"a number is expected{unit and f', in {unit}'}")
    require(lies(value, within), place, value, between(within), unit)


def require_ranges(given: Any, ranges: Mapping[str, Range], lanes: bool = False) -> None:
    """Refuse numbers of a dataclass that make no sense; a default always does.

    Parameters
    ----------
    given : dataclass
    ranges : mapping of str to Range
    lanes : bool
        See `require_range`.

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
            require_range(name, value, within, lanes)
        except InputError as error:
            raise InputError(f"{error}{_or_default(default, within)}", error.at) from None


def require_whole(place: Place, value: Any, least: int, most: int, unit: str = "") -> None:
    """Refuse what is no whole number, or one that makes no sense.

    Raises
    ------
    InputError
        With the place, the value and the range.
    """
    of = f" {unit}" if unit else ""
    whole = isinstance(value, Integral) and not isinstance(value, bool)
    require(whole, place, value, f"a whole number is expected{of and f', in{of}'}")
    require(least <= value <= most, place, value, f"must lie between {least} and {most}{of}", unit)


def require_choices(given: Any, choices: Mapping[str, Collection[str]]) -> None:
    """Refuse fields of a dataclass that are none of the words they can be.

    Raises
    ------
    InputError
        With the name, the value and the words of the first one.
    """
    for name, words in choices.items():
        value = getattr(given, name)
        right = isinstance(value, str) and value in words
        require(right, name, value, f"must be one of {', '.join(words)}")


def require_flag(place: Place, value: Any) -> None:
    """Refuse what is neither true nor false.

    Raises
    ------
    InputError
        With the place and the value.
    """
    require(isinstance(value, bool | np.bool_), place, value, "true or false is expected")


def require_text(place: Place, value: Any, what: str = "text") -> None:
    """Refuse what is no text, or empty.

    Raises
    ------
    InputError
        With the place, the value and ``what`` is expected.
    """
    require(isinstance(value, str) and value != "", place, value, f"{what} is expected")


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
            what = f"has no effect with kind = {given.kind!r}, only with {kind!r}; leave it out"
            require(value == usual[name], name, value, what)


def require_instance(place: Place, value: Any, kind: type, what: str = "") -> None:
    """Refuse what is not of a kind.

    Raises
    ------
    InputError
        With the place, the value and ``what`` is expected: ``a World``.
    """
    require(isinstance(value, kind), place, value, f"{what or kind.__name__} is expected")


def require_part(place: Place, value: Any, what: str, methods: Iterable[str]) -> None:
    """Refuse what lacks a method that it will be asked for, and classes where an object is needed.

    Raises
    ------
    InputError
        With the place, the value, ``what`` is expected, and the first method that is missing.
    """
    missing = [name for name in methods if not callable(getattr(value, name, None))]
    whole = not missing and not isinstance(value, type)
    lacks = f", with a method {missing[0]}" if missing else ", not its class"
    require(whole, place, value, f"{what} is expected{lacks}")


def _or_default(default: Any, within: Range) -> str:
    """Return what else may be given where the default lies outside of the range."""
    if default is None or default == math.inf:
        return ", or be left out"
    inside = not is_number(default) or within[0] <= default <= within[1]
    return "" if inside else f", or be {default:g}"


def is_array(value: Any) -> TypeGuard[np.ndarray]:
    """Return whether a value is an array of numbers, not an empty one."""
    return isinstance(value, np.ndarray) and value.dtype.kind in "iuf" and value.size > 0


def are_numbers(value: Any, shape: tuple[int, ...] = ()) -> bool:
    """Return whether a value is real numbers of a shape, of Python or NumPy; () is one alone."""
    right = isinstance(value, float | int | np.generic | np.ndarray)
    return right and np.shape(value) == shape and np.asarray(value).dtype.kind in "fiub"


def between(within: Range) -> str:
    """Return what must hold of a number in a range, for messages."""
    low, high, unit = within
    return f"must lie between {low:g} and {high:g}{unit and f' {unit}'}"


def lies(value: Any, within: Range) -> bool:
    """Return whether a number, or every number of an array, lies within a range."""
    low, high, _ = within
    if is_array(value):
        return bool(np.all((low <= value) & (value <= high)))
    return bool(low <= value <= high)


def listed(value: Any) -> Any:
    """Return lists and arrays as tuples, which can be compared and stay as they are."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    return tuple(map(listed, value)) if isinstance(value, list | tuple) else value
