"""Tables in files: CSV, Parquet and NumPy, read into columns by name."""

from __future__ import annotations

import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from cowalk.sim.basics.errors import InputError

Table = tuple[dict[str, Any], dict[str, str]]
"""Columns by name, None for a name that several have; units that the file states, by name."""

_SEPARATORS = {";": "semicolons", "\t": "tabs"}


def faulty(path: Path, what: str) -> InputError:
    """Return the error of a recording's file."""
    return InputError(f"file = {str(path)!r}: {what}", ("file",))


def first_line(error: Exception) -> str:
    """Return the first line of what another library says."""
    return str(error).partition("\n")[0]


def read_table(path: Path) -> Table:
    """Return the columns of a file, and the units that it states for them.

    Raises
    ------
    InputError
        If the file's ending is not known, or the file is missing or cannot be read.
    """
    reader = _READERS.get(path.suffix)
    if reader is None:
        raise faulty(path, f"ends in none of {', '.join(_READERS)}")
    if not path.is_file():
        raise faulty(path, "there is no such file")
    return reader(path)


def _columns(table: Any) -> dict[str, Any]:
    """Return an Arrow table's columns by name; None for a name that several have."""
    names = table.column_names
    return {
        name: None if names.count(name) > 1 else table.column(i) for i, name in enumerate(names)
    }


def _read_csv(path: Path) -> Table:
    from pyarrow import ArrowInvalid, csv

    with path.open("rb") as file:
        header = file.readline()
    try:
        header.decode("utf-8")
        other = next((name for sign, name in _SEPARATORS.items() if sign.encode() in header), None)
        if other and b"," not in header:
            raise faulty(
                path,
                f"its columns are separated by {other}; save it with commas between "
                "columns, and points in numbers",
            )
        return _columns(csv.read_csv(path)), {}
    except UnicodeDecodeError as error:
        raise faulty(
            path,
            f"its header is not UTF-8 (byte {header[error.start]:#04x}); save the file as UTF-8",
        ) from error
    except ArrowInvalid as error:
        raise faulty(path, f"cannot be read as CSV: {first_line(error)}") from error


def _read_parquet(path: Path) -> Table:
    from pyarrow import ArrowInvalid, parquet

    try:
        table = parquet.read_table(path)
    except (ArrowInvalid, OSError) as error:
        raise faulty(path, f"cannot be read as Parquet: {first_line(error)}") from error
    units = {
        field.name: field.metadata[b"unit"].decode()
        for field in table.schema
        if field.metadata and b"unit" in field.metadata
    }
    return _columns(table), units


def _read_numpy(path: Path) -> Table:
    try:
        with path.open("rb") as file:  # np.load leaves a damaged one open
            data = np.load(file, allow_pickle=False)
            if isinstance(data, np.lib.npyio.NpzFile):
                with data:
                    return dict(data), {}
    except (ValueError, OSError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        # NumPy's own words advise to load it unsafely.
        if str(error).startswith("Object arrays"):
            what = "holds Python objects; save arrays of numbers"
        else:
            what = f"is damaged, or no {path.suffix} file; write it anew with np.save or np.savez"
        raise faulty(path, f"cannot be read as NumPy: it {what}") from error
    if data.dtype.names:
        return {name: data[name] for name in data.dtype.names}, {}
    if data.ndim != 2:
        raise faulty(path, f"an array of shape {data.shape}; (rows, columns) is needed")
    return {str(i): column for i, column in enumerate(data.T)}, {}


_READERS = {
    ".csv": _read_csv,
    ".parquet": _read_parquet,
    ".npy": _read_numpy,
    ".npz": _read_numpy,
}
