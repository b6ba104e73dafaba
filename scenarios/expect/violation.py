"""Where a formula that fails first does so, and where it came closest to holding."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.motion import Array

from .formula import NUMBERS, is_bounded_future, kind, steps
from .grammar import Node
from .margin import margins

_AHEAD = ("Always", "Eventually", "Until")
_MOST = 4
"""As many numbers are shown; one line holds no more."""


@dataclass(frozen=True)
class Closest:
    """Where an ``eventually`` that fails came closest to holding.

    Attributes
    ----------
    row : int
    values : dict of str to float
        What it compares there, by its text; empty where that is not one row's matter.
    """

    row: int
    values: dict[str, float]


class Failure:
    """A formula that fails on a trace.

    Parameters
    ----------
    columns : mapping of str to ndarray, shape (rows,)
    period : float
        Control period, s.
    optimistic : bool
        See `margins`.
    """

    def __init__(self, columns: Mapping[str, Array], period: float, *, optimistic: bool) -> None:
        self._columns = columns
        self._period = period
        self._optimistic = optimistic
        self._rows = len(next(iter(columns.values())))

    def _margins(self, node: Node) -> Array:
        return margins(node, self._columns, self._period, optimistic=self._optimistic)

    def _window(self, node: Node, row: int) -> slice:
        """Return the rows that a temporal operator looks at from one, and one at least."""
        if not is_bounded_future(node):
            return slice(row, self._rows)
        begin, end = (min(row + count, self._rows - 1) for count in steps(node, self._period))
        return slice(begin, end + 1)

    def first_violation(self, node: Node) -> int | None:
        """Return the row that first violated a formula: see `Verdict.violated_at`."""
        if kind(node) in ("Always", "TimedAlways"):
            window = self._window(node, 0)
            return self._first_broken(node, window)
        if kind(node) == "Conjunction":
            failing = [child for child in node.children if self._margins(child)[0] < 0.0]
            rows = [self.first_violation(child) for child in failing]
            return min((row for row in rows if row is not None), default=None)
        if kind(node) in ("Eventually", "TimedEventually"):
            return None  # it lacks a row that holds; none breaks it
        horizon = self._horizon(node)
        return horizon if horizon < self._rows else None

    def _first_broken(self, always: Node, window: slice) -> int:
        """Return the first row of a window that breaks an ``always``."""
        broken = self._margins(always.children[0])[window] < 0.0
        return int(window.start) + int(np.argmax(broken))

    def _horizon(self, node: Node) -> int:
        """Return the last row that a formula asks for, seen from the first one."""
        if kind(node) in _AHEAD:
            return self._rows
        own = int("Next" in kind(node))
        if is_bounded_future(node):
            own = steps(node, self._period)[1]
        return own + max(map(self._horizon, node.children), default=0)

    def closest(self, node: Node, row: int = 0) -> Closest | None:
        """Return where the ``eventually`` by which a formula fails in a row came closest."""
        children = node.children
        if kind(node) in ("Eventually", "TimedEventually"):
            window = self._window(node, row)
            best = window.start + int(np.argmax(self._margins(children[0])[window]))
            return Closest(best, self._values(children[0], best))
        if kind(node) in ("Always", "TimedAlways"):
            return self.closest(children[0], self._first_broken(node, self._window(node, row)))
        if kind(node) == "Conjunction":
            return self.closest(min(children, key=lambda child: self._margins(child)[row]), row)
        if kind(node) == "Disjunction":
            return self.closest(max(children, key=lambda child: self._margins(child)[row]), row)
        return self.closest(children[1], row) if kind(node) == "Implies" else None

    def _values(self, node: Node, row: int) -> dict[str, float]:
        """Return the numbers that a formula compares in a row, without constants."""
        values: dict[str, float] = {}
        for part in _within(node):
            if kind(part) not in NUMBERS | {"Predicate", "Neg", "Conjunction", "Disjunction"}:
                return {}
            if kind(part) == "Predicate":
                for number in part.children:
                    if any(kind(each) == "Variable" for each in _within(number)):
                        seen = self._margins(number)  # of a number: its values
                        values[number.text] = float(seen[row])
        return dict(list(values.items())[:_MOST])


def _within(node: Node) -> Iterator[Node]:
    yield node
    for child in node.children:
        yield from _within(child)
