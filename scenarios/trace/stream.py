"""A trace written while a run goes on, so that what ends the process does not end the trace.

An Arrow IPC stream: a message with the columns, then one a batch of rows. Unlike a Parquet file,
which has its index at its end, it can be read as far as it was written.
"""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cowalk.sim.basics.errors import InputError

from .trace import FORMAT, Trace

if TYPE_CHECKING:
    from collections.abc import Mapping

EVERY = 10.0
"""At least so often rows are written, s of the clock on the wall."""
MOST = 20_000
"""Rows after which they are written at once: a few megabytes."""
_FORM = b"cowalk.format"


class TraceStream:
    """Writes the rows of a trace that grows, now and then.

    Parameters
    ----------
    file : Path
        Made with the first rows.

    Attributes
    ----------
    rows : int
        How many are in the file.
    failure : OSError or None
        Why the last attempt to write failed. Nothing is lost by it, unless the process ends: the
        next attempt writes what is missing.
    """

    def __init__(self, file: Path) -> None:
        self.rows = 0
        self.failure: OSError | None = None
        self._file, self._end = file, 0
        self._next = time.monotonic() + EVERY

    def follow(self, trace: Trace) -> None:
        """Write the rows that are new, if it is time."""
        if time.monotonic() >= self._next or len(trace) - self.rows >= MOST:
            self.write(trace)

    def write(self, trace: Trace) -> None:
        """Write the rows that are new, so that another process finds them."""
        self._next = time.monotonic() + EVERY
        if len(trace) == self.rows:
            return
        # Imported by now: whoever keeps a trace writes it as Parquet in the end.
        import pyarrow as pa

        schema = _schema(pa, trace.units)
        arrays = [pa.py_buffer(np.ascontiguousarray(column)) for column in _new(trace, self.rows)]
        count = len(trace) - self.rows
        batch = pa.RecordBatch.from_arrays(
            [pa.Array.from_buffers(pa.float64(), count, [None, data]) for data in arrays],
            schema=schema,
        )
        head = b"" if self._end else schema.serialize().to_pybytes()
        try:
            self._append(head + batch.serialize().to_pybytes())
        except OSError as failure:
            self.failure = failure
        else:
            self.failure, self.rows = None, len(trace)

    def _append(self, message: bytes) -> None:
        """Write at the end of what is whole; what an earlier attempt left there is overwritten."""
        with self._file.open("r+b" if self._end else "wb", buffering=0) as out:
            out.seek(self._end)
            rest = memoryview(message)
            while rest:
                rest = rest[out.write(rest) :]
            out.truncate()
        self._end = os.path.getsize(self._file)


def _new(trace: Trace, since: int) -> list[Any]:
    return [column[since:] for column in trace.columns().values()]


def _schema(pa: Any, units: Mapping[str, str]) -> Any:
    fields = [pa.field(name, pa.float64(), metadata={"unit": units[name]}) for name in units]
    return pa.schema(fields, metadata={_FORM: str(FORMAT)})


def read_stream(file: Path) -> Trace:
    """Return the trace that a `TraceStream` wrote, to the last batch that is whole.

    Raises
    ------
    InputError
        If it is no such file, or of another form of the trace.
    """
    import pyarrow as pa

    try:
        data = pa.py_buffer(file.read_bytes())
        reader = pa.ipc.open_stream(data)
        schema = reader.schema
    except OSError as error:
        raise InputError(f"{file}: cannot be read ({error.strerror or error})") from error
    except (pa.ArrowException, ValueError) as error:
        raise InputError(f"{file}: no trace of a run that was ended ({error})") from error
    form = (schema.metadata or {}).get(_FORM, b"").decode(errors="replace")
    if form != str(FORMAT):
        raise InputError(f"{file}: of form {form or 'none'!r}, this cowalk reads form {FORMAT}")
    if any(field.type != pa.float64() for field in schema):
        raise InputError(f"{file}: numbers are expected in every column")
    units = {
        field.name: (field.metadata or {}).get(b"unit", b"").decode(errors="replace")
        for field in schema
    }
    if len(units) != len(schema) or "t" not in units:
        raise InputError(f"{file}: not the columns of a trace")
    blocks = [np.empty((0, len(units)))]
    while True:
        try:
            batch = reader.read_next_batch()
            batch.validate(full=True)
            columns = [column.to_numpy(zero_copy_only=False) for column in batch.columns]
        except (StopIteration, OSError, ValueError, pa.ArrowException):
            break  # the end, or what was being written when the process ended
        blocks.append(np.stack(columns, axis=-1))
    return Trace.of(units, np.concatenate(blocks))
