"""What no recording of a force by hand can be, and rows that are missing."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from .signal import Signal

_GAP = (5.0, 0.05)
"""Step of time at which rows are missing: as a multiple of the usual one, and in s."""
_STRONGEST = 500.0
"""Force that nobody exerts by hand, N."""
_STEPS = (1e-5, 0.5)
"""Sampling steps that a recording of a force may have, s."""
_SAME = 0.01
"""By what share of it a stated rate may differ from that of the time that a file holds."""


def refuse_implausible(signal: Signal, rate: float | None) -> None:
    """Refuse a recording whose time does not rise or is not that of a rate, or too large a force.

    Parameters
    ----------
    signal : Signal
    rate : float or None
        Hz.

    Raises
    ------
    InputError
        With file, column and row.
    """
    faulty, units, time, force = signal.table.faulty, signal.units, signal.time, signal.force
    steps = np.diff(time)
    column = signal.names.get("time", "")
    falling = np.flatnonzero(steps <= 0.0)
    if len(falling):
        row = int(falling[0]) + 1
        raise faulty(
            f"column {column!r} does not rise in row {signal.row(row)}: "
            f"{time[row]:g} s after {time[row - 1]:g} s"
        )
    step = np.median(steps)
    if column and not _STEPS[0] <= step <= _STEPS[1]:
        raise faulty(
            f"rows are {step:g} s apart with units.time = {units['time']!r}; is the "
            f"column {column!r} in another unit?"
        )
    if column and rate is not None:
        # Stamps may be rounded, which only their mean forgives, or rows be missing.
        whole = steps[~_missing(steps)]
        found = (1.0 / float(step), 1.0 / float(whole.mean()))
        if not any(abs(one - rate) <= _SAME * rate for one in found):
            raise InputError(
                f"rate = {rate:g} Hz: column {column!r} of {str(signal.table.path)!r} says "
                f"{found[1]:.4g} Hz; leave one of them out",
                ("rate",),
            )
    row, axis = divmod(int(np.argmax(np.abs(force))), force.shape[1])
    role = ("fx", "fy", "fz")[axis]
    if abs(force[row, axis]) > _STRONGEST:
        raise faulty(
            f"column {signal.names[role]!r} reads {force[row, axis]:g} N in row "
            f"{signal.row(row)} with units.force = {units[role]!r}, more than anybody "
            "pushes; is it in another unit?"
        )


def without_gaps(signal: Signal, gaps: Literal["refuse", "hold"]) -> tuple[Array, Array]:
    """Return time and force of a recording whose missing rows hold the last force, or refuse it.

    Raises
    ------
    InputError
        With file, row and how to go on.
    """
    time, force = signal.time, signal.force
    steps = np.diff(time)
    before = np.flatnonzero(_missing(steps))
    if not len(before):
        return time, force
    usual = np.median(steps)
    if gaps == "refuse":
        row = int(before[np.argmax(steps[before])])
        raise signal.table.faulty(
            f"nothing for {steps[row]:.3g} s from {time[row]:g} s on (row "
            f"{signal.row(row)}, {len(before)} such gaps, rows are {usual:g} s apart); cut the "
            "recording there, or say gaps: hold to keep the last force"
        )
    # The last force, up to one usual step before the next row.
    after = before + 1
    return (
        np.insert(time, after, time[after] - usual),
        np.insert(force, after, force[before], axis=0),
    )


def _missing(steps: Array) -> Any:
    """Return after which steps of time, s, rows are missing."""
    return (steps > _GAP[0] * np.median(steps)) & (steps > _GAP[1])
