"""Time and force of a recording, and the rows of the file that they come from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from cowalk.sim.basics.motion import Array

from .tables import Table


@dataclass(frozen=True)
class Signal:
    """The rows of a file that hold a force.

    Attributes
    ----------
    table : Table
    rows : ndarray of int, shape (n,)
        Their numbers in the table.
    names, units : dict of str to str
        Column and unit of ``"fx"``, ``"fy"``, where there are such ``"fz"`` and ``"time"``.
    time : ndarray, shape (n,)
        s.
    force : ndarray, shape (n, 2) or (n, 3)
        N, in the order of ``names``.
    """

    table: Table
    rows: Any
    names: dict[str, str]
    units: dict[str, str]
    time: Array
    force: Array

    def row(self, index: int) -> int:
        """Return how a message names one of the rows."""
        return self.table.row(int(self.rows[index]))
