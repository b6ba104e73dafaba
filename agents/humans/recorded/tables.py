"""Tables in files: CSV, Parquet and NumPy, read into columns by name."""

from __future__ import annotations

import os
import zipfile
import zlib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.file_names import what_it_is

from .layout import Layout, csv_layout


@dataclass(frozen=True)
class Table:
    """What a file holds.

    Attributes
    ----------
    path : Path
    columns : dict of str to array
        By name; None for a name that several have. Without names, by number from "0".
    units : dict of str to str
        What the file states of its columns' units, apart from their names.
    named : bool
        Whether the columns have names.
    layout : Layout, optional
        Of a CSV file.
    """

    path: Path
    columns: dict[str, Any]
    units: dict[str, str] = field(default_factory=dict)
    named: bool = True
    layout: Layout | None = None

    def row(self, index: int) -> int:
        """Return how a message names a row: the line of a CSV file from 1, else from 0."""
        return index if self.layout is None else self.layout.line(self.path, index)

    def faulty(self, what: str) -> InputError:
        """Return the error of this file; see `faulty`."""
        return faulty(self.path, what)


def faulty(path: Path, what: str) -> InputError:
    """Return the error of a recording's file."""
    return InputError(f"file = {str(path)!r}: {what}", ("file",))


def _first_line(error: Exception) -> str:
    """Return the first line of what another library says."""
    return str(error).partition("\n")[0]


def read_table(path: Path) -> Table:
    """Return the columns of a file, and the units that it states for them.

    Raises
    ------
    InputError
        If the file's ending, in small letters or capitals, is not known, or the file is missing
        or cannot be read.
    """
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        raise faulty(path, f"ends in none of {', '.join(_READERS)}")
    if not os.path.isfile(path):
        what = what_it_is(path)
        raise faulty(path, "there is no such file" if what is None else f"this {what}")
    return reader(path)


def _by_name(names: list[str], columns: Iterable[Any]) -> dict[str, Any]:
    """Return columns by name; None for a name that several have."""
    return {
        name: None if names.count(name) > 1 else column
        for name, column in zip(names, columns, strict=True)
    }


def _read_csv(path: Path) -> Table:
    from pyarrow import ArrowInvalid, csv, string

    try:
        layout = csv_layout(path)
        # Columns are read by number, so that any names will do.
        numbers = [str(number) for number in range(len(layout.names))]
        reading = csv.ReadOptions(skip_rows=layout.skipped, column_names=numbers)
        try:
            found = csv.read_csv(path, read_options=reading)
        except ArrowInvalid as error:
            if "conversion error" not in str(error):
                raise
            # What a column holds is guessed from the file's first megabyte; some cell is not so.
            text = csv.ConvertOptions(column_types=dict.fromkeys(numbers, string()))
            found = csv.read_csv(path, read_options=reading, convert_options=text)
    except ValueError as error:  # Arrow's own errors are some
        raise faulty(path, f"cannot be read as CSV: {_first_line(error)}") from error
    columns = _by_name(layout.names, found.columns)
    return Table(path, columns, named=layout.named, layout=layout)


def _read_parquet(path: Path) -> Table:
    from pyarrow import ArrowInvalid, parquet

    try:
        table = parquet.read_table(path)
    except (ArrowInvalid, OSError) as error:
        raise faulty(path, f"cannot be read as Parquet: {_first_line(error)}") from error
    units = {
        field.name: field.metadata[b"unit"].decode()
        for field in table.schema
        if field.metadata and b"unit" in field.metadata
    }
    return Table(path, _by_name(table.column_names, table.columns), units)


def _read_numpy(path: Path) -> Table:
    try:
        with path.open("rb") as file:  # np.load leaves a damaged one open
            data = np.load(file, allow_pickle=False)
            if isinstance(data, np.lib.npyio.NpzFile):
                with data:
                    return Table(path, dict(data))
    except (ValueError, OSError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        # NumPy's own words advise to load it unsafely.
        if str(error).startswith("Object arrays"):
            what = "holds Python objects; save arrays of numbers"
        else:
            what = f"is damaged, or no {path.suffix} file; write it anew with np.save or np.savez"
        raise faulty(path, f"cannot be read as NumPy: it {what}") from error
    if data.dtype.names:
        return Table(path, {name: data[name] for name in data.dtype.names})
    if data.ndim != 2:
        raise faulty(path, f"an array of shape {data.shape}; (rows, columns) is needed")
    return Table(path, {str(i): column for i, column in enumerate(data.T)}, named=False)


_READERS = {
    ".csv": _read_csv,
    ".parquet": _read_parquet,
    ".npy": _read_numpy,
    ".npz": _read_numpy,
}
