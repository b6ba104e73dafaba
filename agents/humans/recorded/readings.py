"""What a cell of text holds: a number, a date, a time of day, or nothing. Pure."""

from __future__ import annotations

from datetime import datetime, time
from typing import Any

_EMPTY = ("", "nan", "na", "n/a", "null")
"""What stands in a cell that holds nothing, in small letters."""
_EPOCH = datetime(1970, 1, 1)


def is_empty(cell: Any) -> bool:
    """Return whether a cell holds nothing."""
    return cell is None or str(cell).strip().lower() in _EMPTY


def number_of(cell: Any) -> float:
    """Return a cell as a number.

    Raises
    ------
    ValueError
        If it is none.
    """
    if isinstance(cell, str) and "_" in cell:
        raise ValueError(f"no number: {cell!r}")  # Python reads 1_0 as ten, others as one
    return float(cell)


def is_number(text: str) -> bool:
    """Return whether a text is a number."""
    try:
        number_of(text)
    except ValueError:
        return False
    return True


def moment_of(text: str) -> datetime | None:
    """Return the date that a text is (ISO 8601), or a time of day as one of 1970; else None."""
    if not any(sign in text for sign in ":-"):
        return None  # without any, Python reads 1230 as half past twelve
    try:
        return datetime.fromisoformat(text.strip())
    except ValueError:
        pass
    try:
        return datetime.combine(_EPOCH, time.fromisoformat(text.strip()))
    except ValueError:
        return None
