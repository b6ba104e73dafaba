"""How far a formula holds: robustness margins of signal temporal logic, on rtamt.

What differs from plain rtamt, so that a margin's sign is always the formula's truth:

- A comparison that holds with nothing to spare has a margin just above 0, one that fails so
  just below: ``x > 0`` at x = 0 fails, ``x >= 0`` holds, and ``not``, ``==``, ``!=``, ``iff``
  and ``xor`` mean what they say.
- A comparison with NaN proves nothing: it counts against the formula, negated or not.

Beside that, rtamt's ``until`` and ``since`` within bounds take a time of rows x bound^2, so that
one of 30 s would take longer than the run: here they take rows x bound.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from cowalk.sim.basics.motion import Array

from .formula import kind, steps
from .grammar import Node
from .rtamt_parts import StlDiscreteTimeOfflineAstVisitor

BARELY = 5e-324
"""Margin of what holds with nothing to spare."""

_ARITHMETIC = {
    "Abs": np.abs,
    "Sqrt": np.sqrt,
    "Exp": np.exp,
    "Pow": np.power,
    "Minimum": np.minimum,
    "Maximum": np.maximum,
    "Addition": np.add,
    "Subtraction": np.subtract,
    "Multiplication": np.multiply,
    "Division": np.divide,
}


def _compare(operator: str, left: Array, right: Array) -> Array:
    """Return by how much a comparison holds."""
    if operator in ("<", "<="):
        left, right = right, left
    margin = left - right if operator not in ("==", "!=") else -np.abs(left - right)
    barely = BARELY if operator in ("==", ">=", "<=") else -BARELY
    if operator == "!=":
        margin = -margin
    # Equal infinities differ by nothing, although their difference is no number.
    return np.where(left == right, barely, margin)


def rate(values: Array, period: float) -> Array:
    """Return the derivative of a signal: the backward difference by the period (s), per second.

    The first row, which has none before it, takes the second's; a single row has no rate (NaN).
    """
    if len(values) < 2:
        return np.full(len(values), np.nan)
    found = np.diff(values) / period
    return np.concatenate([found[:1], found])


def _until(hold: Array, reach: Array, begin: int, end: int) -> Array:
    """Return by how much, for each row, one thing is reached within steps and another holds until.

    Beyond the last row nothing is reached.
    """
    rows = len(hold)
    best, held = np.full(rows, -np.inf), np.full(rows, np.inf)
    for ahead in range(min(end, rows - 1) + 1):
        seen = slice(rows - ahead)  # whoever has a row so far ahead
        if ahead >= begin:
            best[seen] = np.maximum(best[seen], np.minimum(held[seen], reach[ahead:]))
        held[seen] = np.minimum(held[seen], hold[ahead:])
    return best


def margins(
    node: Node,
    columns: Mapping[str, Array],
    period: float,
    *,
    optimistic: bool = False,
    fixed: tuple[Node, float] | None = None,
) -> Array:
    """Return the margin of a formula seen from every row: above 0 where it holds.

    Parameters
    ----------
    node
        Root of the formula or of a part of it.
    columns
        The trace, each column of shape (rows,).
    period
        Control period, s.
    optimistic
        Count comparisons with NaN in favour of the formula instead of against it.
    fixed
        A part of the formula, and the margin that it is given in every row.

    Returns
    -------
    ndarray, shape (rows,)
        In the unit of what is compared.
    """
    rows = len(next(iter(columns.values())))
    with np.errstate(all="ignore"):
        found = _Margins(columns, period, fixed).visit(node, rows, -1.0 if optimistic else 1.0)
    return np.asarray(found, dtype=float)


class _Margins(StlDiscreteTimeOfflineAstVisitor):  # type: ignore[misc]
    """rtamt's offline semantics; ``sign`` is the polarity of NaN, turned by every negation."""

    def __init__(
        self, columns: Mapping[str, Array], period: float, fixed: tuple[Node, float] | None
    ) -> None:
        self._columns = columns
        self._period = period
        self._rows = len(next(iter(columns.values())))
        self._fixed: Node = fixed[0] if fixed else None
        self._margin = fixed[1] if fixed else 0.0
        self._known: dict[tuple[int, float], list[float]] = {}

    def visit(self, node: Node, rows: int, sign: float) -> Any:
        if node is self._fixed:
            return [self._margin] * rows
        if kind(node) == "Variable":
            return np.asarray(self._columns[node.var], dtype=float)
        if kind(node) == "Constant":
            return np.full(rows, node.val)
        if kind(node) == "Rate":
            return rate(self.visit(node.children[0], rows, sign), self._period)
        if arithmetic := _ARITHMETIC.get(kind(node)):
            return arithmetic(*(self.visit(child, rows, sign) for child in node.children))
        key = (id(node), sign)
        if key not in self._known:  # iff and unless ask more than once
            # rtamt's own visit would also keep results under their nodes, whatever the sign.
            self._known[key] = super(StlDiscreteTimeOfflineAstVisitor, self).visit(node, rows, sign)
        return list(self._known[key])  # rtamt's operators add rows to what they get

    def time_unit_transformer(self, node: Node) -> tuple[int, int]:
        # Beyond the last row there is nothing, however far: rtamt would fill it up.
        begin, end = steps(node, self._period)
        return min(begin, self._rows), min(end, self._rows)

    def _both(self, node: Node, rows: int, sign: float) -> Any:
        """Yield for each row what left and right are, as such and for use in a negation."""
        left, right = node.children
        return zip(
            self.visit(left, rows, sign),
            self.visit(left, rows, -sign),
            self.visit(right, rows, sign),
            self.visit(right, rows, -sign),
            strict=True,
        )

    def visitPredicate(self, node: Node, rows: int, sign: float) -> list[float]:
        left, right = (self.visit(child, rows, sign) for child in node.children)
        margin = _compare(str(node.operator), left, right)
        return [float(value) for value in np.where(np.isnan(margin), -np.inf * sign, margin)]

    def visitNot(self, node: Node, rows: int, sign: float) -> list[float]:
        return [-value for value in self.visit(node.children[0], rows, -sign)]

    def visitImplies(self, node: Node, rows: int, sign: float) -> list[float]:
        return [max(-no_left, right) for _, no_left, right, _ in self._both(node, rows, sign)]

    def visitIff(self, node: Node, rows: int, sign: float) -> list[float]:
        return [
            min(max(-no_left, right), max(-no_right, left))
            for left, no_left, right, no_right in self._both(node, rows, sign)
        ]

    def visitXor(self, node: Node, rows: int, sign: float) -> list[float]:
        return [
            max(min(left, -no_right), min(-no_left, right))
            for left, no_left, right, no_right in self._both(node, rows, sign)
        ]

    def visitRise(self, node: Node, rows: int, sign: float) -> list[float]:
        now = self.visit(node.children[0], rows, sign)
        before = [-np.inf, *self.visit(node.children[0], rows, -sign)]
        return [min(-last, value) for last, value in zip(before, now, strict=False)]

    def visitFall(self, node: Node, rows: int, sign: float) -> list[float]:
        no_now = self.visit(node.children[0], rows, -sign)
        before = [np.inf, *self.visit(node.children[0], rows, sign)]
        return [min(last, -value) for last, value in zip(before, no_now, strict=False)]

    def visitTimedUntil(self, node: Node, rows: int, sign: float) -> list[float]:
        hold, reach = (np.array(self.visit(child, rows, sign)) for child in node.children)
        found = _until(hold, reach, *self.time_unit_transformer(node))
        return [float(value) for value in found]

    def visitTimedSince(self, node: Node, rows: int, sign: float) -> list[float]:
        hold, reach = (np.array(self.visit(child, rows, sign)) for child in node.children)
        found = _until(hold[::-1], reach[::-1], *self.time_unit_transformer(node))
        return [float(value) for value in found[::-1]]
