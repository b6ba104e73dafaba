"""Units of a recording's columns: what the scenario says, and what the file says."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import did_you_mean
from cowalk.sim.basics.validators import require

from .tables import faulty

TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Known units of time, in s."""
FORCE_UNITS = {"N": 1.0, "mN": 1e-3, "kN": 1e3, "lbf": 4.4482216152605, "kgf": 9.80665}
"""Known units of force, in N."""

_SPELLINGS = {
    "s": "sec secs second seconds",
    "ms": "msec msecs millis millisecond milliseconds",
    "us": "µs μs usec usecs µsec μsec micros microsecond microseconds",
    "ns": "nsec nsecs nanos nanosecond nanoseconds",
    "N": "newton newtons",
    "mN": "millinewton millinewtons",
    "kN": "kilonewton kilonewtons",
    "lbf": "poundforce pound-force pounds-force",
    "kgf": "kp kilopond kiloponds",
}
"""How else units are written."""
_BRACKET = re.compile(r"\[([^\[\]]*)\]|\(([^()]*)\)")
"""Where a column's name may hold its unit: ``t [ms]``, ``Fx (kN) filtered``."""
_NOTED = re.compile(r"\s\[\s*([^\W\d_]{2,}[^\[\]]*)\]\s*$")
"""A word that stands where a unit does, known or not: ``Fx [stone]``, not ``F[0]``."""
_ENDING = re.compile(r"[\s_./-]([^\W\d_]+)$")
"""What may be a unit, if it is known as one: ``fx_mn``, ``force/N``, but ``/force/x``."""
_OTHER = (
    "Nm Nmm mNm Ncm V mV uV kg g mg lb lbs oz mm cm mps rad deg Hz min Pa kPa bar psi mA counts"
)
_JOINTS = re.compile(r"[\s/*·.^²³\d-]+")
_KNOWN = {
    spelling.lower(): unit
    for unit in (*TIME_UNITS, *FORCE_UNITS)
    for spelling in (unit, *_SPELLINGS[unit].split())
}
_WORDS = {*_KNOWN, *_OTHER.lower().split()}
"""Words that are units, of time, of force, or of what is neither."""
_BRACKETED = {*_WORDS, "m"}
"""Likewise where they stand in brackets: ``[m/s]``, but not ``fx_m``, m for measured."""


@dataclass(frozen=True, kw_only=True)
class Units:
    """Units of a recording's columns.

    Parameters
    ----------
    time : {"s", "ms", "us", "ns"}, optional
        Unless given, what the file says: a Parquet field's metadata, or the column's name
        (``t_ms``, ``t [msec]``, ``t/ms``); s where it says nothing.
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
            right = unit is None or (isinstance(unit, str) and unit in known)
            require(right, name, unit, did_you_mean(str(unit), list(known)))


def suits(path: Path, quantity: str, name: str, units: Units, stated: dict[str, str]) -> bool:
    """Return whether a column may hold a quantity, see `unit_of`."""
    try:
        unit_of(path, quantity, name, units, stated)
    except InputError:
        return False
    return True


def unit_of(path: Path, quantity: str, name: str, units: Units, stated: dict[str, str]) -> str:
    """Return the unit of a column: what the scenario says, the file, or s and N.

    Parameters
    ----------
    path : Path
        For messages.
    quantity : {"time", "force"}
    name : str
        The column's.
    units : Units
        What the scenario says.
    stated : dict of str to str
        What the file says of its columns, apart from their names.

    Raises
    ------
    InputError
        If the file says something else than the scenario, or something that is no unit of
        this quantity.
    """
    known = TIME_UNITS if quantity == "time" else FORCE_UNITS
    wanted: str | None = getattr(units, quantity)
    found = stated.get(name) or _named(name)
    if found is None and wanted is None and (noted := _NOTED.search(name)):
        raise faulty(
            path,
            f"column {name!r} is in {noted[1].strip()!r}; known: {', '.join(known)}; if that "
            f"is no unit, say units.{quantity}",
        )
    if found is None:
        return wanted or next(iter(known))
    found = _KNOWN.get(found.lower(), found)
    if found not in known:
        raise faulty(
            path, f"column {name!r} is in {found!r}; known: {', '.join(known)}; map another column"
        )
    if wanted not in (None, found):
        raise faulty(
            path,
            f"column {name!r} is in {found!r}, the scenario says {wanted!r}; leave "
            f"units.{quantity} out, or map another column",
        )
    return found


def _named(name: str) -> str | None:
    """Return the unit that a column's name holds, as it is written there."""
    for texts in reversed(_BRACKET.findall(name)):
        text = "".join(texts).strip()
        words = {word.lower() for word in _JOINTS.split(text) if word}
        if words and words <= _BRACKETED:
            return text
    ending = _ENDING.search(name)
    return ending[1] if ending and ending[1].lower() in _WORDS else None
