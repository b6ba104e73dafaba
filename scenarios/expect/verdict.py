"""What must hold in a run: named formulas in signal temporal logic, judged with a margin.

A formula speaks of trace columns row by row: ``always (clearance >= 0.0)``,
``eventually[0:5s] (y > 0.4)``, ``always ((t > 12) implies (fy >= 1.0))``. It is judged at the
first row, from which bounds count, in whole control periods.

At the end of the trace: what was not recorded is not held against ``always``, and does not
count for ``eventually`` or ``until``. A window cut short is judged on what there is; a formula
of which some part looks only beyond the end fails, since nothing shows that it holds.

Columns may be infinite (no obstacle: infinite clearance). A formula whose verdict hangs on a
NaN fails and says so.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

if TYPE_CHECKING:
    from .formula import Formula, Node


@dataclass(frozen=True)
class Verdict:
    """The judgement of one expectation.

    Attributes
    ----------
    name, formula : str
    robustness : float
        Margin in the unit of what the formula compares, below 0 where it fails; NaN where
        there is none (see ``reason``).
    passed : bool
    violated_at : float or None
        Time in s at which a failed formula was first violated: within an outermost ``always``
        the first row that breaks it, else the row that settled it, such as the last one of an
        ``eventually``.
    reason : str or None
        Why it failed, where that is not a matter of a margin.
    """

    name: str
    formula: str
    robustness: float
    passed: bool
    violated_at: float | None = None
    reason: str | None = None


def explain(verdict: Verdict) -> str:
    """Return in one line by how much an expectation holds, or how and when it failed."""
    if verdict.passed:
        return f"margin {verdict.robustness:.3g}"
    when = (
        "" if verdict.violated_at is None else f", first violated at t = {verdict.violated_at:g} s"
    )
    return f"{verdict.reason or f'margin {verdict.robustness:.3g}'}{when}"


def syntax_error(formula: str, columns: Collection[str], period: float | None = None) -> str | None:
    """Return what is wrong with a formula, in one line, or None.

    Parameters
    ----------
    formula
        The formula's text.
    columns
        Columns that there are.
    period
        Control period in s, to check that bounds are whole multiples of it.
    """
    from .formula import FormulaError, check_bounds, parse

    try:
        root = parse(formula, columns).root
        if period is not None:
            check_bounds(root, period)
    except FormulaError as error:
        return str(error)
    return None


def judge(expect: Mapping[str, str], columns: Mapping[str, Array], period: float) -> list[Verdict]:
    """Return a verdict for each expectation, in their order.

    Parameters
    ----------
    expect : mapping of str to str
        Formula by name.
    columns : mapping of str to ndarray, shape (rows,)
        The trace; ``t`` gives the times, rows are one period apart.
    period : float
        Control period, s.

    Raises
    ------
    InputError
        If a formula cannot be understood.
    """
    return [_judge(name, formula, columns, period) for name, formula in expect.items()]


def _judge(name: str, text: str, columns: Mapping[str, Array], period: float) -> Verdict:
    from .formula import parse
    from .margin import BARELY, margins

    if reason := syntax_error(text, columns, period):
        raise InputError(f"expect.{name} = {text!r}: {reason}")
    formula = parse(text, columns)
    rows = len(next(iter(columns.values())))
    if rows == 0:
        return Verdict(name, text, np.nan, False, reason="nothing was recorded")
    if (start := _start(formula.root, period)) >= rows:
        reason = f"it looks from {start * period:g} s on, but the run ended at {rows * period:g} s"
        return Verdict(name, text, np.nan, False, reason=reason)
    margin = float(margins(formula.root, columns, period)[0])
    if margin > 0.0:
        return Verdict(name, text, 0.0 if margin == BARELY else margin, True)
    at_best = float(margins(formula.root, columns, period, optimistic=True)[0])
    undecided = at_best > 0.0
    row = _first_violation(formula.root, columns, period, optimistic=not undecided)
    return Verdict(
        name,
        text,
        np.nan if undecided else 0.0 if at_best == -BARELY else at_best,
        False,
        _time(columns, row, period),
        _not_a_number(formula, columns, period) if undecided else None,
    )


def _time(columns: Mapping[str, Array], row: int, period: float) -> float:
    return float(columns["t"][row]) if "t" in columns else (row + 1) * period


def _not_a_number(formula: Formula, columns: Mapping[str, Array], period: float) -> str:
    for column in formula.columns:
        missing = np.isnan(columns[column])
        if missing.any():
            first = _time(columns, int(np.argmax(missing)), period)
            count = f"{missing.sum()} of {len(missing)} rows"
            return f"{column} is not a number (NaN) in {count}, first at t = {first:g} s"
    return "its arithmetic gives no number (0/0, the root of a negative number, inf - inf)"


def _start(node: Node, period: float) -> int:
    """Return the row before which some part of a formula does not look at the trace at all."""
    from .formula import is_bounded_future, steps

    begin = steps(node, period)[0] if is_bounded_future(node) else 0
    return begin + max((_start(child, period) for child in node.children), default=0)


def _first_violation(
    node: Node, columns: Mapping[str, Array], period: float, *, optimistic: bool
) -> int:
    """Return the row that first violated a formula that fails (see `Verdict`)."""
    from .formula import kind, steps
    from .margin import margins

    rows = len(next(iter(columns.values())))
    if kind(node) in ("Always", "TimedAlways"):
        begin, end = steps(node, period) if kind(node) == "TimedAlways" else (0, rows - 1)
        inner = margins(node.children[0], columns, period, optimistic=optimistic)
        return begin + int(np.argmax(inner[begin : end + 1] < 0.0))
    if kind(node) == "Conjunction":
        return min(
            _first_violation(child, columns, period, optimistic=optimistic)
            for child in node.children
            if margins(child, columns, period, optimistic=optimistic)[0] < 0.0
        )
    return min(_horizon(node, period, rows), rows - 1)


def _horizon(node: Node, period: float, rows: int) -> int:
    """Return the last row that a formula looks at, seen from the first one."""
    from .formula import is_bounded_future, kind, steps

    if kind(node) in ("Always", "Eventually", "Until"):
        return rows - 1
    own = steps(node, period)[1] if is_bounded_future(node) else int("Next" in kind(node))
    return own + max((_horizon(child, period, rows) for child in node.children), default=0)
