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
    from .formula import Formula
    from .grammar import Node


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
        the first row that breaks it, else the row that settled it. None where no row did: an
        ``eventually`` lacks one that holds, others are settled by the run's end alone.
    reason : str or None
        Why it failed, where that is not a matter of a margin.
    closest_at : float or None
        Time in s at which a failed ``eventually`` came closest to holding.
    closest : dict of str to float, or None
        What it compares, by its text, and the value that it had then.
    vacuous : str or None
        How a formula that holds would also do so if something that it asks for never did (see
        `cowalk.scenarios.expect.vacuity`), or which of its columns is unknown in the whole run.
    """

    name: str
    formula: str
    robustness: float
    passed: bool
    violated_at: float | None = None
    reason: str | None = None
    closest_at: float | None = None
    closest: dict[str, float] | None = None
    vacuous: str | None = None


def explain(verdict: Verdict) -> str:
    """Return in one line by how much an expectation holds, or how and when it failed."""
    said = verdict.reason or f"margin {verdict.robustness:.3g}"
    if verdict.vacuous is not None:
        said += f", vacuously: {verdict.vacuous}"
    if verdict.closest_at is not None:
        said += f", closest at t = {verdict.closest_at:g} s"
    if verdict.closest:
        values = (f"{name} = {value:.3g}" for name, value in verdict.closest.items())
        said += f" with {', '.join(values)}"
    if verdict.violated_at is not None and verdict.reason is None:
        said += f", first violated at t = {verdict.violated_at:g} s"
    return said


def syntax_error(
    formula: str,
    columns: Collection[str],
    period: float | None = None,
    duration: float | None = None,
) -> str | None:
    """Return what is wrong with a formula, in one line, or None.

    Parameters
    ----------
    formula
        The formula's text.
    columns
        Columns that there are.
    period
        Control period in s, to check that bounds are whole multiples of it.
    duration
        How long the run lasts at most, s, to check that all of the formula lies within it; taken
        into account with a period only.
    """
    from .formula import check_bounds, parse
    from .grammar import FormulaError

    try:
        root = parse(formula, columns).root
        if period is not None:
            check_bounds(root, period, duration)
            if duration is not None and (start := _start(root, period) * period) >= duration:
                return f"it looks from {start:g} s on, but the run is over by then: {duration:g} s"
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
    from .vacuity import vacuous

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
        margin = 0.0 if margin == BARELY else margin
        empty = _unknown(formula, columns) or vacuous(formula.root, columns, period)
        return Verdict(name, text, margin, True, vacuous=empty)
    at_best = float(margins(formula.root, columns, period, optimistic=True)[0])
    return _failed(name, text, formula, columns, period, at_best)


def _failed(
    name: str,
    text: str,
    formula: Formula,
    columns: Mapping[str, Array],
    period: float,
    at_best: float,
) -> Verdict:
    """Return the verdict on a formula that fails, by its margin with NaN counted in its favour."""
    from .margin import BARELY
    from .violation import Failure

    undecided = at_best > 0.0
    failure = Failure(columns, period, optimistic=not undecided)
    closest = None if undecided else failure.closest(formula.root)
    violated = failure.first_violation(formula.root)
    reason = None
    if undecided:
        reason = _not_a_number(formula, columns, period)
    elif np.isneginf(at_best) and all(np.isfinite(columns[each]).all() for each in formula.columns):
        reason = "it looks before the first row or beyond the last, where nothing is recorded"
    return Verdict(
        name,
        text,
        np.nan if undecided else 0.0 if at_best == -BARELY else at_best,
        False,
        None if violated is None else _time(columns, violated, period),
        reason,
        None if closest is None else _time(columns, closest.row, period),
        None if closest is None else closest.values,
    )


def _time(columns: Mapping[str, Array], row: int, period: float) -> float:
    return float(columns["t"][row]) if "t" in columns else (row + 1) * period


def _unknown(formula: Formula, columns: Mapping[str, Array]) -> str | None:
    """Return which column of a formula says nothing in the whole run, or None."""
    for column in formula.columns:
        if np.isnan(columns[column]).all():
            return f"{column} is unknown in this run: not a number (NaN) in any row"
    return None


def _not_a_number(formula: Formula, columns: Mapping[str, Array], period: float) -> str:
    if unknown := _unknown(formula, columns):
        return unknown
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
