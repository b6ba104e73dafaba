"""The two seats of the environment."""

from __future__ import annotations

from typing import Any

from .validators import require

SEATS = ("human", "automation")
"""In the order in which they are stepped."""


def require_seats(given: Any) -> None:
    """Refuse a dataclass whose ``seen_by`` names seats that there are not.

    Raises
    ------
    InputError
        If it is no list, or an entry is neither ``"human"`` nor ``"automation"``.
    """
    seats = given.seen_by
    right = isinstance(seats, tuple | list) and all(seat in SEATS for seat in seats)
    listed = list(seats) if isinstance(seats, tuple) else seats
    require(right, "seen_by", listed, f"its entries are {' or '.join(SEATS)}")
    object.__setattr__(given, "seen_by", tuple(seats))
