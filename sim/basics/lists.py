"""Validators of lists in a dataclass: of numbers, of rows of numbers, of things of one kind.

Lists and arrays become tuples, which can be compared and stay as they are.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .validators import (
    Range,
    between,
    is_array,
    is_number,
    lies,
    listed,
    require,
    require_instance,
    require_range,
)


def require_entries(given: Any, names: Iterable[str], count: int, within: Range) -> None:
    """Refuse fields of a dataclass that are not so many sensible numbers.

    Raises
    ------
    InputError
        With the name, or the place of the entry, and the value of the first one.
    """
    of = " of at least 0" if within[0] == 0.0 else ""
    for name in names:
        value = listed(getattr(given, name))
        right = isinstance(value, tuple) and len(value) == count
        right = right and all(is_number(entry) and abs(entry) < math.inf for entry in value)
        require(right, name, value, f"must be {count} finite numbers{of}")
        for number, entry in enumerate(value):
            require_range((name, number), entry, within)
        object.__setattr__(given, name, value)


def require_pairs(given: Any, ranges: Mapping[str, Range], axis: int = 0) -> None:
    """Refuse fields of a dataclass that are not two numbers, or make no sense.

    Each number may be an array, a value for each of a batch.

    Parameters
    ----------
    given : dataclass
    ranges : mapping of str to Range
    axis : int
        Axis that holds the two where an array is given: 0, or -1 for shape (..., 2).

    Raises
    ------
    InputError
        With the name, the value and the range of the first one.
    """
    for name, within in ranges.items():
        value = getattr(given, name)
        if isinstance(value, np.ndarray):
            holds = is_array(value) and value.ndim > 0 and value.shape[axis] == 2
        else:
            holds = isinstance(value, tuple | list) and len(value) == 2
            holds = holds and all(is_number(part) or is_array(part) for part in value)
        require(holds, name, value, "must be two numbers, for v and for omega")
        require(all(lies(part, within) for part in value), name, value, between(within))


def require_rows(given: Any, name: str, columns: Sequence[Range], least: int, what: str) -> None:
    """Refuse a field of a dataclass that is no list of rows of sensible numbers.

    Parameters
    ----------
    given : dataclass
    name : str
    columns : sequence of Range
        Of the numbers in each row.
    least : int
        Number of rows that there must be.
    what : str
        What is right, for messages.

    Raises
    ------
    InputError
        With the place and the value of the first fault.
    """
    rows = listed(getattr(given, name))
    require(isinstance(rows, tuple) and len(rows) >= least, name, rows, what)
    for number, row in enumerate(rows):
        right = isinstance(row, tuple) and len(row) == len(columns)
        require(right, (name, number), row, f"{len(columns)} numbers are expected")
        for entry, (value, within) in enumerate(zip(row, columns, strict=True)):
            require_range((name, number, entry), value, within)
    object.__setattr__(given, name, rows)


def require_instances(given: Any, kinds: Mapping[str, type]) -> None:
    """Refuse fields of a dataclass that are no lists of things of a kind each.

    Raises
    ------
    InputError
        With the place and the value of the first fault.
    """
    for name, kind in kinds.items():
        value = getattr(given, name)
        what = f"a list of {kind.__name__} is expected"
        require(isinstance(value, tuple | list), name, value, what)
        for number, thing in enumerate(value):
            require_instance((name, number), thing, kind)
        object.__setattr__(given, name, tuple(value))
