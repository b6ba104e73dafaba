"""The two seats of the environment."""

from __future__ import annotations

from .errors import InputError

SEATS = ("human", "automation")
"""In the order in which they are stepped."""


def check_seats(seen_by: tuple[str, ...]) -> None:
    """Refuse seats that there are not.

    Raises
    ------
    InputError
        If an entry is neither ``"human"`` nor ``"automation"``.
    """
    for seat in seen_by:
        if seat not in SEATS:
            raise InputError(f"seen_by = {list(seen_by)}: its entries are {' or '.join(SEATS)}")
