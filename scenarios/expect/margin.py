"""How far a formula holds: robustness margins of signal temporal logic, on rtamt.

What differs from plain rtamt, so that a margin's sign is always the formula's truth:

- A comparison that holds with nothing to spare has a margin just above 0, one that fails so
  just below: ``x > 0`` at x = 0 fails, ``x >= 0`` holds, and ``not``, ``==``, ``!=``, ``iff``
  and ``xor`` mean what they say.
- A comparison with NaN proves nothing: it counts against the formula, negated or not.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from cowalk.sim.basics.motion import Array

from .formula import Node, kind, steps
from .rtamt_parts import StlDiscreteTimeOfflineAstVisitor

BARELY = 5e-324
"""Margin of what holds with nothing to spare."""

_ARITHMETIC = {
    "Abs": np.abs,
    "Sqrt": np.sqrt,
    "Exp": np.exp,
    "Pow": np.power,
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


def margins(
    node: Node, columns: Mapping[str, Array], period: float, *, optimistic: bool = False
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

    Returns
    -------
    ndarray, shape (rows,)
        In the unit of what is compared.
    """
    rows = len(next(iter(columns.values())))
    with np.errstate(all="ignore"):
        found = _Margins(columns, period).visit(node, rows, -1.0 if optimistic else 1.0)
    return np.asarray(found, dtype=float)


class _Margins(StlDiscreteTimeOfflineAstVisitor):  # type: ignore[misc]
    """rtamt's offline semantics; ``sign`` is the polarity of NaN, turned by every negation."""

    def __init__(self, columns: Mapping[str, Array], period: float) -> None:
        self._columns = columns
        self._period = period

    def visit(self, node: Node, rows: int, sign: float) -> Any:
        if kind(node) == "Variable":
            return np.asarray(self._columns[node.var], dtype=float)
        if kind(node) == "Constant":
            return np.full(rows, node.val)
        if arithmetic := _ARITHMETIC.get(kind(node)):
            return arithmetic(*(self.visit(child, rows, sign) for child in node.children))
        # rtamt's own visit would also keep every result, which nobody here asks for.
        return super(StlDiscreteTimeOfflineAstVisitor, self).visit(node, rows, sign)

    def time_unit_transformer(self, node: Node) -> tuple[int, int]:
        return steps(node, self._period)

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
