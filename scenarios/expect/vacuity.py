"""Formulas that hold without having asked anything of a run.

A formula holds vacuously if it would still hold were something that it asks for never so: that
part did not matter (Beer, Ben-David, Eisner and Rodeh, "Efficient detection of vacuity in ACTL
formulas", CAV 1997, doi 10.1007/3-540-63166-6_28). Here one part after the other is given the
worst margin in every row, and the formula judged again. What is asked for is the conclusion
of ``implies``, and what must hold in every row of a time: the operand of ``always`` and
``historically``, of ``next`` and ``prev``, and what comes before ``until``, ``unless`` and
``since``; under ``not``, that of ``eventually`` and ``once``. Alternatives are none: ``or`` may
hold by one side alone, ``iff`` and ``xor`` ask for both ways.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from cowalk.sim.basics.motion import Array

from .formula import kind
from .grammar import Node
from .margin import margins

_EVERY_ROW = {"Always", "Historically", "Until", "Since", "Next", "Previous"}
"""Asks its first operand of every row that it looks at."""
_SOME_ROW = {
    "Eventually": 0,
    "Once": 0,
    "Until": 1,
    "Since": 1,
    "StrongNext": 0,
    "StrongPrevious": 0,
}
"""Asks an operand of some row, so that its negation asks the opposite of every row."""
_BOTH_WAYS = {"Iff", "Xor", "Rise", "Fall", "Predicate"}


def vacuous(node: Node, columns: Mapping[str, Array], period: float) -> str | None:
    """Return in one line how a formula that holds does so vacuously, or None.

    Parameters
    ----------
    node
        Root of the formula.
    columns
        The trace, each column of shape (rows,).
    period
        Control period, s.
    """
    for asking, part, asserted in _asked(node, asserted=True):
        worst = -np.inf if asserted else np.inf
        if margins(node, columns, period, fixed=(part, worst))[0] > 0.0:
            how = f"it would hold even if {part.text} {'never' if asserted else 'always'} did"
            if kind(asking) == "Implies":
                premise = asking.children[0]
                if not (margins(premise, columns, period, optimistic=True) > 0.0).any():
                    return f"{how}: {premise.text} never holds"
            return how
    return None


def _asked(node: Node, *, asserted: bool) -> Iterator[tuple[Node, Node, bool]]:
    """Yield what asks, what it asks for, and whether it is to hold or not to; outer ones first."""
    name = kind(node).removeprefix("Timed")
    children = node.children
    if name in _BOTH_WAYS:
        return
    if _is_unless(node):
        yield node, children[0].children[0], asserted
        return
    if name == ("Disjunction" if asserted else "Conjunction"):
        return
    if asserted and name in _EVERY_ROW:
        yield node, children[0], True
    if not asserted and name in _SOME_ROW:
        yield node, children[_SOME_ROW[name]], False
    if asserted and name == "Implies":
        yield node, children[1], True
        yield from _asked(children[1], asserted=True)  # that the premise fails is an alternative
        return
    for place, child in enumerate(children):
        turned = name == "Neg" or (name == "Implies" and place == 0)
        yield from _asked(child, asserted=asserted != turned)


def _is_unless(node: Node) -> bool:
    """Return whether an ``or`` is rtamt's reading of ``unless``."""
    if kind(node) != "Disjunction" or "Always" not in kind(node.children[0]):
        return False
    always, until = node.children
    return "Until" in kind(until) and until.children[0] is always.children[0]
