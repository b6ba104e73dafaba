"""Recorded forces: read from a file, checked, and resampled to the control rate."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from scipy.interpolate import make_interp_spline

from cowalk.sim.errors import InputError
from cowalk.sim.motion import Array
from cowalk.sim.registry import did_you_mean

TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Known units of time, in s."""
FORCE_UNITS = {"N": 1.0, "mN": 1e-3, "kN": 1e3, "lbf": 4.4482216152605, "kgf": 9.80665}
"""Known units of force, in N."""

_SUFFIX = re.compile(r"[\s_\[(/]([A-Za-z]+)[\])]?$")
"""A unit at the end of a column's name: ``fx_mn``, ``t [ms]``, ``Fx (kN)``."""
_STRONGEST = 500.0
"""Force that nobody exerts by hand, N."""
_STEPS = (1e-5, 0.5)
"""Sampling steps that a recording of a force may have, s."""


@dataclass(frozen=True, kw_only=True)
class Columns:
    """Names of a recording's columns; an array without names has them by number, from 0.

    Parameters
    ----------
    time, fx, fy : str
        Time, and force on the base forward and to the left.
    """

    time: str = "t_s"
    fx: str = "fx_n"
    fy: str = "fy_n"


@dataclass(frozen=True, kw_only=True)
class Units:
    """Units of a recording's columns.

    Parameters
    ----------
    time : {"s", "ms", "us", "ns"}, optional
        Unless given, what the file says: a Parquet field's metadata, or the end of the
        column's name (``t_ms``, ``t [ms]``); s where it says nothing.
    force : {"N", "mN", "kN", "lbf", "kgf"}, optional
        Likewise (``fx_mn``, ``Fx [mN]``); N where the file says nothing.

    Raises
    ------
    InputError
        If a unit is not known.
    """

    time: Literal["s", "ms", "us", "ns"] | None = None
    force: Literal["N", "mN", "kN", "lbf", "kgf"] | None = None

    def __post_init__(self) -> None:
        for name, known in (("time", TIME_UNITS), ("force", FORCE_UNITS)):
            unit = getattr(self, name)
            if unit is not None and unit not in known:
                raise InputError(f"units.{name} = {unit!r}: {did_you_mean(unit, list(known))}")


def read_recording(file: str, columns: Columns, units: Units) -> tuple[Array, Array]:
    """Return time and force of a recording, checked.

    Parameters
    ----------
    file : str
        ``.csv``, ``.parquet``, ``.npy`` or ``.npz``.
    columns : Columns
    units : Units
        What the file itself says of a unit must agree.

    Returns
    -------
    time : ndarray, shape (n,)
        s from the first row, rising.
    force : ndarray, shape (n, 2)
        N.

    Raises
    ------
    InputError
        If the file cannot be read, a column is missing, holds no numbers or stands in another
        unit, a value is missing or not finite, or time does not rise: file, column and row.
    """
    path = Path(file).expanduser()
    reader = _READERS.get(path.suffix)
    if reader is None:
        raise InputError(f"{_at(path)}: ends in none of {', '.join(_READERS)}")
    if not path.is_file():
        raise InputError(f"{_at(path)}: there is no such file")
    table, stated = reader(path)
    first_row = 2 if path.suffix == ".csv" else 0  # a CSV file's line, the header being line 1
    names = {"time": columns.time, "fx": columns.fx, "fy": columns.fy}
    values, used = {}, {}
    for role, name in names.items():
        if name not in table:
            raise InputError(f"{_at(path)}: no column {name!r}; {did_you_mean(name, list(table))}")
        if table[name] is None:
            raise InputError(f"{_at(path)}: more than one column is called {name!r}; rename one")
        used[role] = _unit(path, "time" if role == "time" else "force", name, units, stated)
        values[role] = _numbers(path, name, table[name], first_row)
    lengths = {names[role]: len(column) for role, column in values.items()}
    if len(set(lengths.values())) > 1:
        raise InputError(f"{_at(path)}: columns differ in length: {lengths}")
    if len(values["time"]) < 2:
        raise InputError(f"{_at(path)}: holds {len(values['time'])} rows; at least 2 are needed")
    time = values["time"] * TIME_UNITS[used["time"]]
    force = np.stack([values[role] * FORCE_UNITS[used[role]] for role in ("fx", "fy")], axis=-1)
    _check_plausible(path, names, used, time, force, first_row)
    return time - time[0], force


def resample(
    time: Array, force: Array, period: float, how: Literal["mean", "linear", "hold"]
) -> Array:
    """Return one force for each control period of a recording.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s from 0, rising.
    force : ndarray, shape (n, 2)
        N.
    period : float
        Control period, s.
    how : {"mean", "linear", "hold"}
        Mean over the period (nothing above the control rate's half aliases into it), value
        between the two nearest samples at its start, or the last sample before it.

    Returns
    -------
    ndarray, shape (floor(time[-1]/period), 2)
        At least one row.
    """
    count = max(1, int(time[-1] / period + 1e-9))
    starts = np.arange(count + 1) * period
    if how == "hold":
        at = np.searchsorted(time, starts[:-1] + 1e-9, side="right") - 1
        return np.asarray(force[at])
    if how == "linear":
        return np.stack([np.interp(starts[:-1], time, part) for part in force.T], axis=-1)
    area = make_interp_spline(time, force, k=1).antiderivative()
    ends = np.minimum(starts, time[-1])
    return np.asarray(np.diff(area(ends), axis=0) / np.diff(ends)[:, None])


def _at(path: Path) -> str:
    return f"file = {str(path)!r}"


def _unit(path: Path, quantity: str, name: str, units: Units, stated: dict[str, str]) -> str:
    """Return the unit of a column: what the scenario says, the file, or s and N."""
    known = TIME_UNITS if quantity == "time" else FORCE_UNITS
    wanted: str | None = getattr(units, quantity)
    found = stated.get(name)
    if found is None and (end := _SUFFIX.search(name)):
        found = {unit.lower(): unit for unit in known}.get(end[1].lower())
    if found is None:
        return wanted or next(iter(known))
    if wanted not in (None, found):
        raise InputError(
            f"{_at(path)}: column {name!r} is in {found!r}, the scenario says {wanted!r}; leave "
            f"units.{quantity} out, or map another column"
        )
    if found not in known:
        raise InputError(f"{_at(path)}: column {name!r} is in {found!r}; known: {', '.join(known)}")
    return found


def _columns(table: Any) -> dict[str, Any]:
    """Return an Arrow table's columns by name; None for a name that several have."""
    names = table.column_names
    return {
        name: None if names.count(name) > 1 else table.column(i) for i, name in enumerate(names)
    }


def _read_csv(path: Path) -> tuple[dict[str, Any], dict[str, str]]:
    from pyarrow import ArrowInvalid, csv

    try:
        table = csv.read_csv(path)
    except ArrowInvalid as error:
        raise InputError(f"{_at(path)}: cannot be read as CSV: {_first_line(error)}") from error
    return _columns(table), {}


def _read_parquet(path: Path) -> tuple[dict[str, Any], dict[str, str]]:
    from pyarrow import ArrowInvalid, parquet

    try:
        table = parquet.read_table(path)
    except ArrowInvalid as error:
        raise InputError(f"{_at(path)}: cannot be read as Parquet: {_first_line(error)}") from error
    units = {
        field.name: field.metadata[b"unit"].decode()
        for field in table.schema
        if field.metadata and b"unit" in field.metadata
    }
    return _columns(table), units


def _read_numpy(path: Path) -> tuple[dict[str, Any], dict[str, str]]:
    try:
        data = np.load(path, allow_pickle=False)
    except (ValueError, OSError) as error:
        raise InputError(f"{_at(path)}: cannot be read as NumPy: {_first_line(error)}") from error
    if isinstance(data, np.lib.npyio.NpzFile):
        with data:
            return dict(data), {}
    if data.dtype.names:
        return {name: data[name] for name in data.dtype.names}, {}
    if data.ndim != 2:
        raise InputError(f"{_at(path)}: an array of shape {data.shape}; (rows, columns) is needed")
    return {str(i): column for i, column in enumerate(data.T)}, {}


_READERS = {
    ".csv": _read_csv,
    ".parquet": _read_parquet,
    ".npy": _read_numpy,
    ".npz": _read_numpy,
}


def _first_line(error: Exception) -> str:
    return str(error).partition("\n")[0]


def _numbers(path: Path, name: str, column: Any, first_row: int) -> Array:
    """Return a column as floats; the first value that is none is named."""
    try:
        values = np.asarray(column).astype(float)
    except (ValueError, TypeError) as error:
        raise InputError(
            f"{_at(path)}: column {name!r} does not hold numbers: {_first_line(error)}"
        ) from error
    if values.ndim != 1:
        raise InputError(f"{_at(path)}: column {name!r} has shape {values.shape}; one value a row")
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        raise InputError(
            f"{_at(path)}: column {name!r} has no finite number in row {wrong[0] + first_row} "
            f"({len(wrong)} such rows); fill or cut the gap"
        )
    return values


def _check_plausible(
    path: Path, names: dict[str, str], units: dict[str, str], time: Array, force: Array, first: int
) -> None:
    steps = np.diff(time)
    falling = np.flatnonzero(steps <= 0.0)
    if len(falling):
        row = falling[0] + 1
        raise InputError(
            f"{_at(path)}: column {names['time']!r} does not rise in row {row + first}: "
            f"{time[row]:g} s after {time[row - 1]:g} s"
        )
    step = np.median(steps)
    if not _STEPS[0] <= step <= _STEPS[1]:
        raise InputError(
            f"{_at(path)}: rows are {step:g} s apart with units.time = {units['time']!r}; is the "
            f"column {names['time']!r} in another unit?"
        )
    row, dimension = np.unravel_index(np.argmax(np.abs(force)), force.shape)
    role = "fx" if dimension == 0 else "fy"
    if abs(force[row, dimension]) > _STRONGEST:
        raise InputError(
            f"{_at(path)}: column {names[role]!r} reads {force[row, dimension]:g} N in row "
            f"{row + first} with units.force = {units[role]!r}, more than anybody "
            "pushes; is it in another unit?"
        )
