"""Formulas of signal temporal logic over trace columns: parsed by rtamt, checked in full."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

from cowalk.sim.basics.registry import did_you_mean

from .grammar import CALLED_LIKE, FormulaError, Node, tokens, tree
from .rtamt_parts import Interval, StlParser

OPERATORS = [
    "always",
    "eventually",
    "until",
    "unless",
    "historically",
    "once",
    "since",
    "next",
    "prev",
    "s_next",
    "s_prev",
    "rise",
    "fall",
    "not",
    "and",
    "or",
    "implies",
    "iff",
    "xor",
    "abs",
    "sqrt",
    "exp",
    "pow",
    *CALLED_LIKE,
]
"""Words that may stand before or after a bracket."""
NUMBERS = {
    "Abs",
    "Addition",
    "Constant",
    "Division",
    "Exp",
    "Maximum",
    "Minimum",
    "Multiplication",
    "Pow",
    "Rate",
    "Sqrt",
    "Subtraction",
    "Variable",
}
"""Kinds of node that stand for a number; all others are true or false."""
_SECONDS = {"s": 1, "ms": 1_000, "us": 1_000_000, "ns": 1_000_000_000, "": 1}


@dataclass(frozen=True)
class Formula:
    """A parsed formula.

    Attributes
    ----------
    root : Node
        Root of its syntax tree.
    columns : tuple of str
        Trace columns that it uses, sorted.
    """

    root: Node
    columns: tuple[str, ...]


def parse(text: str, columns: Collection[str]) -> Formula:
    """Return a formula over some of the columns.

    Raises
    ------
    FormulaError
        If it is no formula, or uses a column that is not there.
    """
    if len(text) > _LONGEST:
        raise FormulaError(f"it has {len(text):,} characters; write it in {_LONGEST:,}")
    names, called = _words(text)
    for name in names:
        if name not in columns and name in called:
            raise FormulaError(f"unknown operator {name!r}; {did_you_mean(name, OPERATORS)}")
        if name not in columns:
            spaces = "put spaces around /; " if "/" in name else ""
            raise FormulaError(
                f"unknown column {name!r}; {spaces}{did_you_mean(name, list(columns))}"
            )
    return Formula(_tree(text, names), names)


_LONGEST = 2_000
"""Characters of a formula: what rtamt reads takes longer with its square."""


def _as_rtamt_wants_it(text: str) -> str:
    return re.sub("!=(?!=)", "!==", text)  # everybody writes it with two characters


@lru_cache
def _words(text: str) -> tuple[tuple[str, ...], frozenset[str]]:
    """Return the names in a formula, sorted, and which of them a bracket follows."""
    found = tokens(_as_rtamt_wants_it(text))
    names = {token.text for token in found if token.type == StlParser.Identifier}
    called = {
        token.text
        for token, after in pairwise(found)
        if token.type == StlParser.Identifier and after.type in (StlParser.LPAREN, StlParser.LBRACK)
    }
    return tuple(sorted(names)), frozenset(called)


@lru_cache  # a formula is checked, then judged, in as many runs as there are
def _tree(text: str, names: tuple[str, ...]) -> Node:
    """Return the root of the syntax tree of a formula over columns; nobody changes it."""
    root = tree(_as_rtamt_wants_it(text), names)
    _require_truth(root)
    _check_operands(root)
    return root


def kind(node: Node) -> str:
    """Return what a node is: the name of rtamt's class, such as ``TimedAlways``."""
    return type(node).__name__


def _require_truth(node: Node) -> None:
    if kind(node) in NUMBERS:
        raise FormulaError(f"{node.text} is a number; compare it, such as {node.text} >= 0")


def _check_operands(node: Node) -> None:
    """Require numbers within comparisons, truths everywhere else, and bounds that rise."""
    for child in node.children:
        if kind(node) not in NUMBERS | {"Predicate"}:
            _require_truth(child)
        elif kind(child) not in NUMBERS:
            raise FormulaError(
                f"{child.text} is true or false, not a number; "
                "join comparisons with and: (0 <= x) and (x <= 1)"
            )
        _check_operands(child)
    if isinstance(node, Interval):
        begin, end = seconds(node)
        if not 0 <= begin <= end:
            raise FormulaError(
                f"the bounds [{float(begin):g} s, {float(end):g} s] must rise from 0 s on"
            )


def seconds(node: Node) -> tuple[Fraction, Fraction]:
    """Return the time bounds of an operator in s; a bound without unit has the other's."""
    begin_unit, end_unit = node.begin_unit or node.end_unit, node.end_unit or node.begin_unit
    return node.begin / _SECONDS[begin_unit], node.end / _SECONDS[end_unit]


def steps(node: Node, period: float) -> tuple[int, int]:
    """Return the time bounds of an operator in control steps.

    Raises
    ------
    FormulaError
        If a bound is not a whole number of control periods (s).
    """
    exact = Fraction(period).limit_denominator(1_000_000)
    begin, end = (bound / exact for bound in seconds(node))
    for count in (begin, end):
        if count.denominator != 1:
            raise FormulaError(
                f"the bound {float(count * exact):g} s is not a whole number of control periods "
                f"of {period:g} s; {float(round(count) * exact):g} s would be"
            )
    return int(begin), int(end)


def is_bounded_future(node: Node) -> bool:
    """Return whether a node is a temporal operator that looks ahead within bounds."""
    return kind(node) in ("TimedAlways", "TimedEventually", "TimedUntil")


def check_bounds(node: Node, period: float, duration: float | None = None) -> None:
    """Require that all time bounds of a formula are whole multiples of the period (s).

    Parameters
    ----------
    node
        Root of the formula.
    period
        Control period, s.
    duration
        How long the run lasts at most, s: no bound may lie beyond it.

    Raises
    ------
    FormulaError
        If one is not, or lies beyond the run's end.
    """
    if isinstance(node, Interval):
        end = seconds(node)[1]
        if duration is not None and end > Fraction(duration).limit_denominator(1_000_000):
            raise FormulaError(
                f"the bound {float(end):g} s lies beyond the end of the run, "
                f"duration = {duration:g} s"
            )
        steps(node, period)
    for child in node.children:
        check_bounds(child, period, duration)
