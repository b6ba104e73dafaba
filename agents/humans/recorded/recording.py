"""Recorded forces: read from a file, and checked."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.registry import did_you_mean
from cowalk.sim.basics.validators import Range, require, require_range, require_text

from .cells import numbers, seconds, texts
from .plausible import refuse_implausible, without_gaps
from .sensor import AS_THE_BASE, RecordingSensor, in_base_axes
from .signal import Signal
from .tables import Table, read_table
from .units import FORCE_UNITS, TIME_UNITS, Units, suits, unit_of

RATE: Range = (2.0, 1e5, "Hz")
"""Of a recording of a force (inferred)."""


@dataclass(frozen=True, kw_only=True)
class Columns:
    """Names of a recording's columns; a file without names has them by number, from 0.

    Parameters
    ----------
    time, fx, fy : str
        Time, and force forward and to the left; of a sensor that is turned, along its axes.
    fz : str, optional
        Force upwards, which counts where the sensor is tilted.

    Raises
    ------
    InputError
        If one is no text.
    """

    time: str = "t_s"
    fx: str = "fx_n"
    fy: str = "fy_n"
    fz: str | None = None

    def __post_init__(self) -> None:
        for name in ("time", "fx", "fy"):
            require_text(name, getattr(self, name), "the name of a column")
        if self.fz is not None:
            require_text("fz", self.fz, "the name of a column")

    @property
    def forces(self) -> tuple[str, ...]:
        """The columns of force that are named, in order x, y, z."""
        return (self.fx, self.fy) if self.fz is None else (self.fx, self.fy, self.fz)


def read_recording(
    file: str,
    columns: Columns,
    units: Units,
    gaps: Literal["refuse", "hold"] = "refuse",
    *,
    rate: float | None = None,
    rows: Mapping[str, str] | None = None,
    sensor: RecordingSensor = AS_THE_BASE,
) -> tuple[Array, Array]:
    """Return time and force of a recording, checked.

    Rows without any force, those of other signals, are left out.

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
    rate : float, optional
        Rows a second, Hz, where no column holds the time.
    rows : mapping of str to str, optional
        What stands in other columns of the rows that count, by their names:
        ``{"topic": "/handle/wrench"}``.
    sensor : RecordingSensor

    Returns
    -------
    time : ndarray, shape (n,)
        s from the first row, rising.
    force : ndarray, shape (n, 2)
        N, base axes.

    Raises
    ------
    InputError
        If the file cannot be read, a column is missing, holds no numbers or stands in another
        unit, a value is missing or not finite, time does not rise or is not that of the rate,
        or rows are missing: file, column and row.
    """
    require(isinstance(file, str | os.PathLike), "file", file, "the path of a file is expected")
    if rate is not None:
        require_range("rate", rate, RATE)
    table = read_table(Path(file).expanduser())
    signal = _read(table, columns, units, rate, rows or {})
    refuse_implausible(signal, rate)
    time, force = without_gaps(signal, gaps)
    time = time - time[0]
    return time, in_base_axes(time, force, sensor)


def _read(
    table: Table, columns: Columns, units: Units, rate: float | None, rows: Mapping[str, str]
) -> Signal:
    """Return the rows that count, every value finite."""
    wanted = _wanted(table, rows)
    timed = rate is None or columns.time in table.columns or columns.time != Columns.time
    named = {"fx": columns.fx, "fy": columns.fy}
    named |= {"fz": columns.fz} if columns.fz is not None else {}
    named |= {"time": columns.time} if timed else {}
    values, used = {}, {}
    for role, name in named.items():
        quantity = "time" if role == "time" else "force"
        _require_column(table, quantity, name, named, units)
        used[role] = unit_of(table.path, quantity, name, units, table.units)
        if role == "time":
            values[role], dated = seconds(table, name)
            used[role] = "s" if dated else used[role]
        else:
            values[role] = numbers(table, name)
    lengths = {named[role]: len(column) for role, column in values.items()}
    if len(set(lengths.values())) > 1:
        raise table.faulty(f"columns differ in length: {lengths}")
    force = np.stack([values[role] for role in named if role != "time"], axis=-1)
    there = ~np.isnan(force).all(axis=-1)
    kept = np.flatnonzero(there if wanted is None else there & wanted)
    if len(kept) < 2:
        raise table.faulty(f"holds {len(kept)} rows; at least 2 are needed")
    for role, name in named.items():
        _refuse_missing(table, name, values[role][kept], kept)
    scales = [FORCE_UNITS[used[role]] for role in named if role != "time"]
    if timed:
        time = values["time"] * TIME_UNITS[used["time"]]
    else:
        counted = np.arange(len(force)) if wanted is None else np.cumsum(wanted)
        time = counted / float(rate or 1.0)
    return Signal(table, kept, named, used, time[kept], (force * scales)[kept])


def _wanted(table: Table, rows: Mapping[str, str]) -> Any:
    """Return which rows hold what they must in other columns; None if nothing is said."""
    wanted = None
    for name, value in rows.items():
        _require_column(table, "", name, {}, Units())
        cells = texts(table, name)
        same = np.array([cell == str(value).strip() for cell in cells])
        if not same.any():
            hint = did_you_mean(str(value), sorted(set(cells))[:20])
            raise table.faulty(f"column {name!r} holds no {str(value)!r}; {hint}")
        wanted = same if wanted is None else wanted & same
    return wanted


def _require_column(
    table: Table, quantity: str, name: str, named: Mapping[str, str], units: Units
) -> None:
    """Refuse a column that is missing, with what may have been meant, or that is there twice."""
    if name not in table.columns:
        cure = 'it names no columns, say columns: {time: "0", fx: "1", fy: "2"}'
        if table.named:
            free = sorted(table.columns.keys() - (set(named.values()) - {name}))
            suited = [other for other in free if _suits(table, quantity, other, units)]
            cure = did_you_mean(name, list(table.columns), suited)
        without = ""
        if quantity == "time":
            without = "; if none holds the time, say rate, the rows a second"
        raise table.faulty(f"no column {name!r}; {cure}{without}")
    if table.columns[name] is None:
        raise table.faulty(f"more than one column is called {name!r}; rename one")


def _refuse_missing(table: Table, name: str, values: Array, kept: Any) -> None:
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        raise table.faulty(
            f"column {name!r} has no finite number in row {table.row(int(kept[wrong[0]]))} "
            f"({len(wrong)} such rows); fill or cut the gap"
        )


def _suits(table: Table, quantity: str, name: str, units: Units) -> bool:
    return not quantity or suits(table.path, quantity, name, units, table.units)
