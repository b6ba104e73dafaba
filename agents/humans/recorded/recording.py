"""Recorded forces: read from a file, checked, and resampled to the control rate."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.registry import did_you_mean
from cowalk.sim.basics.validators import require, require_text

from .tables import faulty, first_line, read_table
from .units import FORCE_UNITS, TIME_UNITS, Units, suits, unit_of

_GAP = (5.0, 0.05)
"""Step of time at which rows are missing: as a multiple of the usual one, and in s."""
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

    Raises
    ------
    InputError
        If one is no text.
    """

    time: str = "t_s"
    fx: str = "fx_n"
    fy: str = "fy_n"

    def __post_init__(self) -> None:
        for name in ("time", "fx", "fy"):
            require_text(name, getattr(self, name), "the name of a column")


def read_recording(
    file: str, columns: Columns, units: Units, gaps: Literal["refuse", "hold"] = "refuse"
) -> tuple[Array, Array]:
    """Return time and force of a recording, checked.

    Parameters
    ----------
    file : str
        ``.csv``, ``.parquet``, ``.npy`` or ``.npz``.
    columns : Columns
    units : Units
        What the file itself says of a unit must agree.
    gaps : {"refuse", "hold"}
        Whether rows may be missing, five usual steps and 50 ms or more; the last force then
        lasts until the next row.

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
        unit, a value is missing or not finite, time does not rise, or rows are missing: file,
        column and row.
    """
    require(isinstance(file, str | os.PathLike), "file", file, "the path of a file is expected")
    path = Path(file).expanduser()
    table, stated = read_table(path)
    first_row = 2 if path.suffix == ".csv" else 0  # a CSV file's line, the header being line 1
    names = {"time": columns.time, "fx": columns.fx, "fy": columns.fy}
    values, used = {}, {}
    for role, name in names.items():
        quantity = "time" if role == "time" else "force"
        free = table.keys() - (set(names.values()) - {name})
        suited = [other for other in sorted(free) if suits(path, quantity, other, units, stated)]
        column = _column(path, name, table, suited)
        used[role] = unit_of(path, quantity, name, units, stated)
        values[role] = _numbers(path, name, column, first_row)
    lengths = {names[role]: len(column) for role, column in values.items()}
    if len(set(lengths.values())) > 1:
        raise faulty(path, f"columns differ in length: {lengths}")
    if len(values["time"]) < 2:
        raise faulty(path, f"holds {len(values['time'])} rows; at least 2 are needed")
    time = values["time"] * TIME_UNITS[used["time"]]
    force = np.stack([values[role] * FORCE_UNITS[used[role]] for role in ("fx", "fy")], axis=-1)
    _check_plausible(path, names, used, time, force, first_row)
    time, force = _without_gaps(path, time, force, first_row, gaps)
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
    # Slow to import, and needed only here.
    from scipy.interpolate import make_interp_spline

    area = make_interp_spline(time, force, k=1).antiderivative()
    ends = np.minimum(starts, time[-1])
    return np.asarray(np.diff(area(ends), axis=0) / np.diff(ends)[:, None])


def _column(path: Path, name: str, table: dict[str, Any], suited: list[str]) -> Any:
    """Return a column; what is missing is told with what may have been meant."""
    if name not in table:
        cure = did_you_mean(name, list(table), suited)
        if all(known.isdecimal() for known in table):
            cure = 'the array has no names, say columns: {time: "0", fx: "1", fy: "2"}'
        raise faulty(path, f"no column {name!r}; {cure}")
    if table[name] is None:
        raise faulty(path, f"more than one column is called {name!r}; rename one")
    return table[name]


def _without_gaps(
    path: Path, time: Array, force: Array, first: int, gaps: Literal["refuse", "hold"]
) -> tuple[Array, Array]:
    """Return a recording whose missing rows hold the last force, or refuse it."""
    steps = np.diff(time)
    usual = np.median(steps)
    before = np.flatnonzero((steps > _GAP[0] * usual) & (steps > _GAP[1]))
    if not len(before):
        return time, force
    if gaps == "refuse":
        row = before[np.argmax(steps[before])]
        raise faulty(
            path,
            f"nothing for {steps[row]:.3g} s from {time[row]:g} s on (row "
            f"{row + first}, {len(before)} such gaps, rows are {usual:g} s apart); cut the "
            "recording there, or say gaps: hold to keep the last force",
        )
    # The last force, up to one usual step before the next row.
    after = before + 1
    return (
        np.insert(time, after, time[after] - usual),
        np.insert(force, after, force[before], axis=0),
    )


def _numbers(path: Path, name: str, column: Any, first_row: int) -> Array:
    """Return a column as floats; the first value that is none is named."""
    try:
        values = np.asarray(column).astype(float)
    except (ValueError, TypeError) as error:
        raise faulty(path, f"column {name!r} does not hold numbers: {first_line(error)}") from error
    if values.ndim != 1:
        raise faulty(path, f"column {name!r} has shape {values.shape}; one value a row")
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        raise faulty(
            path,
            f"column {name!r} has no finite number in row {wrong[0] + first_row} "
            f"({len(wrong)} such rows); fill or cut the gap",
        )
    return values


def _check_plausible(
    path: Path, names: dict[str, str], units: dict[str, str], time: Array, force: Array, first: int
) -> None:
    steps = np.diff(time)
    falling = np.flatnonzero(steps <= 0.0)
    if len(falling):
        row = falling[0] + 1
        raise faulty(
            path,
            f"column {names['time']!r} does not rise in row {row + first}: "
            f"{time[row]:g} s after {time[row - 1]:g} s",
        )
    step = np.median(steps)
    if not _STEPS[0] <= step <= _STEPS[1]:
        raise faulty(
            path,
            f"rows are {step:g} s apart with units.time = {units['time']!r}; is the "
            f"column {names['time']!r} in another unit?",
        )
    row, dimension = np.unravel_index(np.argmax(np.abs(force)), force.shape)
    role = "fx" if dimension == 0 else "fy"
    if abs(force[row, dimension]) > _STRONGEST:
        raise faulty(
            path,
            f"column {names[role]!r} reads {force[row, dimension]:g} N in row "
            f"{row + first} with units.force = {units[role]!r}, more than anybody "
            "pushes; is it in another unit?",
        )
