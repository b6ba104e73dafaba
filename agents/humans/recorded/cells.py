"""Cells of a table as numbers and times: what is neither is named with its row."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cowalk.sim.basics.motion import Array

from .readings import is_empty, is_number, moment_of, number_of
from .tables import Table

_NUMERIC, _DATED = "biuf", "mM"
"""Kinds of NumPy's types: numbers; durations and dates."""


def numbers(table: Table, name: str) -> Array:
    """Return a column as floats, NaN where a cell is empty.

    Raises
    ------
    InputError
        If a cell holds anything but a number: column, row and what is there.
    """
    cells = _flat(table, name)
    if cells.dtype.kind in _NUMERIC:
        return cells.astype(float)
    if cells.dtype.kind in _DATED:
        raise table.faulty(f"column {name!r} does not hold numbers, but dates")
    return _each(table, name, cells, number_of, "does not hold numbers")


def seconds(table: Table, name: str) -> tuple[Array, bool]:
    """Return a column of times as floats, NaN where a cell is empty, and whether it is dated.

    Dates (ISO 8601, with or without a zone), times of day and durations are in s, dates from
    the first on; numbers are as they are, in whatever unit.

    Raises
    ------
    InputError
        If a cell holds neither: column, row and what is there.
    """
    cells = _flat(table, name)
    if cells.dtype.kind in _NUMERIC:
        return cells.astype(float), False
    if cells.dtype.kind in _DATED:
        there = cells[~np.isnat(cells)]
        since = cells - there[0] if len(there) and cells.dtype.kind == "M" else cells
        return np.asarray(since / np.timedelta64(1, "s")), True
    first = next((str(cell) for cell in cells if not is_empty(cell)), "")
    moment = moment_of(first)
    if moment is None or is_number(first):
        return _each(table, name, cells, number_of, "holds neither numbers nor dates"), False

    def since_first(cell: Any) -> float:
        other = moment_of(str(cell))
        if other is None:
            raise ValueError
        return (other - moment).total_seconds()

    what = "does not hold dates of one kind, such as 2024-03-01T12:00:00.250,"
    return _each(table, name, cells, since_first, what), True


def texts(table: Table, name: str) -> list[str]:
    """Return the cells of a column as text, whole numbers without a point."""
    cells = _flat(table, name)
    return [f"{cell:g}" if isinstance(cell, float) else str(cell).strip() for cell in cells]


def _flat(table: Table, name: str) -> NDArray[Any]:
    """Return a column as an array of one axis; empty cells of text are None or empty."""
    cells = np.asarray(table.columns[name])
    if cells.ndim != 1:
        raise table.faulty(f"column {name!r} has shape {cells.shape}; one value a row")
    return cells


def _each(table: Table, name: str, cells: Any, reads: Callable[[Any], float], what: str) -> Array:
    """Return every cell as a float, or name the first that is none."""
    values, wrong = np.full(len(cells), np.nan), []
    for index, cell in enumerate(cells):
        if is_empty(cell):
            continue
        try:
            values[index] = reads(cell)
        except (ValueError, TypeError):
            wrong.append(index)
    if wrong:
        row, word = table.row(wrong[0]), str(cells[wrong[0]])
        raise table.faulty(
            f"column {name!r} {what}: {word!r} in row {row} ({len(wrong)} such rows); correct or "
            "cut them"
        )
    return values
