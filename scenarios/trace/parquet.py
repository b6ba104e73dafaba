"""Named columns with units, as a Parquet file that every tool reads."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

_FORM = b"cowalk.format"


def write_columns(
    file: Path,
    columns: Mapping[str, Array],
    units: Mapping[str, str],
    form: int,
    whole: Collection[str] = (),
) -> None:
    """Write columns, each field with its unit as metadata ``unit``.

    Parameters
    ----------
    file : Path
    columns : mapping of str to ndarray, shape (rows,)
        Of numbers.
    units : mapping of str to str
    form : int
        Number of the form, kept in the file's metadata as ``cowalk.format``.
    whole : collection of str
        Columns of whole numbers; NaN becomes 0 in them.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    fields, arrays = [], []
    for name, column in columns.items():
        values = np.nan_to_num(column).astype(np.int64) if name in whole else column
        data = np.ascontiguousarray(values)
        # pa.array would import pandas where it is installed, to ask whether these are a series.
        buffers = [None, pa.py_buffer(data)]
        array = pa.Array.from_buffers(pa.from_numpy_dtype(data.dtype), len(data), buffers)
        fields.append(pa.field(name, array.type, metadata={"unit": units[name]}))
        arrays.append(array)
    schema = pa.schema(fields, metadata={_FORM: str(form)})
    table = pa.Table.from_arrays(arrays, schema=schema)
    with file.open("wb") as out:  # a name would be taken for an address where it looks like one
        pq.write_table(table, out)


def read_columns(file: Path) -> tuple[dict[str, Array], dict[str, str], int]:
    """Return columns, their units, and the number of the form, 1 where the file has none.

    Raises
    ------
    InputError
        If it is no such file, or a column of it does not hold numbers.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    try:
        with file.open("rb") as source:
            table = pq.read_table(source)
    except (OSError, pa.ArrowInvalid) as error:
        raise InputError(f"{file}: cannot be read as a Parquet file ({error})") from error
    units = {
        field.name: (field.metadata or {}).get(b"unit", b"").decode() for field in table.schema
    }
    for field in table.schema:
        if not (pa.types.is_floating(field.type) or pa.types.is_integer(field.type)):
            what = f"column {field.name!r} holds {field.type}; numbers are expected"
            raise InputError(f"{file}: {what}")
    form = (table.schema.metadata or {}).get(_FORM, b"1").decode(errors="replace")
    if not form.isdecimal():
        raise InputError(f"{file}: {_FORM.decode()} = {form!r}: a whole number is expected")
    return {name: table.column(name).to_numpy() for name in table.column_names}, units, int(form)
