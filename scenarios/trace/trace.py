"""The trace of a run: one row a control step, one column a quantity."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.validators import require, require_whole

from .columns import UNITS

if TYPE_CHECKING:
    from pandas import DataFrame

FORMAT = 3
"""Number of the form in which traces and run folders are written.

1 had no number, and ended with the column ``clearance``. 2 invented wish and stubbornness where
a force was prescribed or recorded, and did not say in which rows stubbornness can be read.
"""
RENAMED: dict[str, str] = {}
"""Columns of earlier forms that have another name now."""
_WHOLE = ("negotiation", "negotiated")

MOST_ROWS = 10_000_000
"""To make room for at first: a week (inferred)."""


class Trace:
    """One row a control step, one column a quantity.

    Parameters
    ----------
    units : mapping of str to str
        Every column and its unit, in order.
    capacity : int
        Number of rows to make room for at first.

    Raises
    ------
    InputError
        If the units are no mapping of text, or the capacity is not from 1 to `MOST_ROWS`.
    """

    def __init__(self, units: Mapping[str, str] = UNITS, capacity: int = 1024) -> None:
        right = isinstance(units, Mapping) and len(units) > 0
        right = right and all(isinstance(text, str) for item in units.items() for text in item)
        require(right, "units", units, "a mapping of columns to units is expected")
        require_whole("capacity", capacity, 1, MOST_ROWS)
        self.units = dict(units)
        self._place = {name: place for place, name in enumerate(units)}
        self._rows = np.empty((capacity, len(units)))
        self._count = 0

    @classmethod
    def of(cls, units: Mapping[str, str], values: Array) -> Trace:
        """Return a trace of rows that are there already.

        Parameters
        ----------
        units : mapping of str to str
            Every column and its unit, in order.
        values : ndarray, shape (rows, columns)
        """
        trace = cls(units, max(1, len(values)))
        trace._rows[: len(values)] = values
        trace._count = len(values)
        return trace

    def append(self, row: Mapping[str, float]) -> None:
        """Add a row: a number for each column, by name."""
        if self._count == len(self._rows):
            self._rows = np.concatenate((self._rows, np.empty_like(self._rows)))
        self._rows[self._count] = [row[name] for name in self._place]
        self._count += 1

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, column: str) -> Array:
        """Return a column, shape (rows,)."""
        return self._rows[: self._count, self._place[column]]

    def columns(self) -> dict[str, Array]:
        """Return every column by name, each of shape (rows,)."""
        return {name: self._rows[: self._count, i] for name, i in self._place.items()}

    def last(self) -> dict[str, float]:
        """Return the newest row: a number for each column."""
        return dict(zip(self._place, self._rows[self._count - 1].tolist(), strict=True))

    @property
    def values(self) -> Array:
        """All rows, shape (rows, columns)."""
        return self._rows[: self._count]

    def to_pandas(self) -> DataFrame:
        """Return a data frame, a row a control step, with the units in ``attrs["units"]``.

        Returns
        -------
        pandas.DataFrame
            A copy, its columns in the order of `units`.

        Raises
        ------
        InputError
            If pandas is not installed.
        """
        try:
            from pandas import DataFrame
        except ImportError as error:
            raise InputError(
                "to_pandas needs pandas, which is not installed; pip install 'cowalk[notebook]'"
            ) from error
        frame = DataFrame(self.columns())
        frame.attrs["units"] = dict(self.units)
        return frame

    def write(self, file: Path) -> None:
        """Write a Parquet file whose fields carry their unit as metadata ``unit``."""
        from .parquet import write_columns

        write_columns(file, self.columns(), self.units, FORMAT, whole=_WHOLE)

    @classmethod
    def read(cls, file: Path) -> Trace:
        """Read what `write` wrote; what an earlier form did not have is NaN.

        Raises
        ------
        InputError
            If a column is missing that every form has, or has another name now, or the file was
            written by a newer cowalk.
        """
        from .parquet import read_columns

        columns, units, form = read_columns(file)
        if form > FORMAT:
            raise InputError(
                f"{file}: written in form {form}, this cowalk reads up to {FORMAT}; install a newer"
            )
        for name in columns:
            if name in RENAMED:
                raise InputError(f"{file}: column {name!r} is called {RENAMED[name]!r} now")
        later = {name for since, names in _LATER.items() if form < since for name in names}
        missing = [name for name in UNITS if name not in {*columns, *later}]
        if missing:
            raise InputError(f"{file}: not a trace: it has no column {', '.join(missing)}")
        rows = len(columns["t"])
        trace = cls(UNITS | units, max(1, rows))
        for name, place in trace._place.items():
            trace._rows[:rows, place] = columns.get(name, np.nan)
        trace._count = rows
        return trace


_AFTER = list(UNITS).index("clearance") + 1
_LATER = {
    2: (*list(UNITS)[_AFTER:], *(name for name in UNITS if name.startswith("sensor_"))),
    3: tuple(
        name
        for name in UNITS
        if name.startswith(
            ("true_demand", "true_insistence", "identifiable", "drive_", "footing_held")
        )
    ),
}
"""Columns by the form that they came with: files of an earlier one may lack them."""
