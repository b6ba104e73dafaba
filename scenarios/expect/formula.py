"""Formulas of signal temporal logic over trace columns: parsed by rtamt, checked in full."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from typing import Any

from cowalk.sim.basics.registry import did_you_mean

from .rtamt_parts import ErrorListener, InputStream, Interval, LtlLexer, StlAst

Node = Any
"""A node of rtamt's syntax tree; rtamt is not typed."""

OPERATORS = [
    "always",
    "eventually",
    "until",
    "historically",
    "once",
    "since",
    "next",
    "prev",
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
]
"""Words that may stand before or after a bracket."""
NUMBERS = {
    "Abs",
    "Addition",
    "Constant",
    "Division",
    "Exp",
    "Multiplication",
    "Pow",
    "Sqrt",
    "Subtraction",
    "Variable",
}
"""Kinds of node that stand for a number; all others are true or false."""
_SECONDS = {"s": 1, "ms": 1_000, "us": 1_000_000, "ns": 1_000_000_000, "": 1}


class FormulaError(ValueError):
    """A formula cannot be understood; the message is one line and says what would be right."""


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


class _Listener(ErrorListener):  # type: ignore[misc]
    """Raises what ANTLR would print."""

    def syntaxError(
        self, recognizer: Any, symbol: Any, line: int, column: int, message: str, error: Any
    ) -> None:
        text = getattr(symbol, "text", None) or message.rpartition("at: ")[2].strip("'")
        if text == "<EOF>":
            raise FormulaError("the formula ends too early; is a bracket or a value missing?")
        before = _text_before(recognizer, symbol)
        hint = f"; write (0 - {text})" if before == "-" else ""
        raise FormulaError(f"{text!r} at character {column + 1} cannot stand there{hint}")


def _text_before(parser: Any, symbol: Any) -> str:
    """Return the text of the token before one that cannot be parsed; empty in the lexer."""
    if symbol is None or symbol.tokenIndex == 0:
        return ""
    return str(parser.getTokenStream().get(symbol.tokenIndex - 1).text)


class _Lexer(LtlLexer):  # type: ignore[misc]
    def __init__(self, stream: Any) -> None:
        super().__init__(stream)
        self._listeners = [_Listener()]


def parse(text: str, columns: Collection[str]) -> Formula:
    """Return a formula over some of the columns.

    Raises
    ------
    FormulaError
        If it is no formula, or uses a column that is not there.
    """
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


def _as_rtamt_wants_it(text: str) -> str:
    return re.sub("!=(?!=)", "!==", text)  # everybody writes it with two characters


@lru_cache
def _words(text: str) -> tuple[tuple[str, ...], frozenset[str]]:
    """Return the names in a formula, sorted, and which of them a bracket follows."""
    tokens = _Lexer(InputStream(_as_rtamt_wants_it(text))).getAllTokens()
    if any(token.type == LtlLexer.EQUAL for token in tokens):
        raise FormulaError("'=' says nothing here; write == to compare")
    names = {token.text for token in tokens if token.type == LtlLexer.Identifier}
    called = {
        token.text
        for token, after in pairwise(tokens)
        if token.type == LtlLexer.Identifier and after.type in (LtlLexer.LPAREN, LtlLexer.LBRACK)
    }
    return tuple(sorted(names)), frozenset(called)


@lru_cache  # a formula is checked, then judged, in as many runs as there are
def _tree(text: str, names: tuple[str, ...]) -> Node:
    """Return the root of the syntax tree of a formula over columns; nobody changes it."""
    tree = StlAst()
    tree.antrlLexerType, tree.parserErrorListenerType = _Lexer, _Listener
    for name in names:
        tree.declare_var(name, "float")
    tree.spec = _as_rtamt_wants_it(text)
    try:
        tree.parse()
    except FormulaError:
        raise
    except Exception as error:  # rtamt fails in its own ways, on unless without bounds for one
        raise FormulaError(
            f"rtamt cannot read this ({error}); do its operators need bounds, such as [0:5s]?"
        ) from error
    if len(tree.specs) != 1:
        raise FormulaError("this is more than one formula; join them with and")
    root = tree.specs[0]
    _require_truth(root)
    _check_operands(root)
    return root


def kind(node: Node) -> str:
    """Return what a node is: the name of rtamt's class, such as ``TimedAlways``."""
    return type(node).__name__


def _require_truth(node: Node) -> None:
    if kind(node) in NUMBERS:
        raise FormulaError(f"{node.name} is a number; compare it, such as {node.name} >= 0")


def _check_operands(node: Node) -> None:
    """Require numbers within comparisons, truths everywhere else, and bounds that rise."""
    for child in node.children:
        if kind(node) not in NUMBERS | {"Predicate"}:
            _require_truth(child)
        elif kind(child) not in NUMBERS:
            raise FormulaError(
                f"{child.name} is true or false, not a number; "
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


def check_bounds(node: Node, period: float) -> None:
    """Require that all time bounds of a formula are whole multiples of the period (s).

    Raises
    ------
    FormulaError
        If one is not.
    """
    if isinstance(node, Interval):
        steps(node, period)
    for child in node.children:
        check_bounds(child, period)
