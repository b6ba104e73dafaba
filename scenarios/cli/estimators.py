"""Tables of estimators: one a dimension, the references among the entries."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any

from .output import emit_table, interval

if TYPE_CHECKING:
    from ..studies.estimator_scores import Estimators, EstimatorScore

ESTIMATORS = ("smoother", "observer", "front end")
"""Kinds of parts that are compared by what they make of people."""
_HEADER = (
    "",
    "RMSE, 1",
    "bias",
    "lag, s",
    "CRPS skill",
    "all rows",
    "covers",
    "gap",
    "better than",
)
_NOTE = """\
RMSE and bias of stubbornness on identifiable rows; CRPS skill there and on all rows, 0 as the
prior; covers: share of stated 90 % intervals that hold the truth; gap: share of the way from the
calibrated paper to the oracle. In brackets bootstrap intervals of 95 % over people. References
are fitted on people who are not scored; prior and oracles are no competitors, and no bounds."""


def emit_estimators(found: Estimators) -> None:
    """Write a table for each dimension, and what it rests on."""
    for each in found.dimensions:
        name = "v" if each.dimension == "v" else "omega"
        heading = (
            f"{found.kind}s in {found.scenario}, stubbornness in {name}: "
            f"{100.0 * each.identifiable:.0f} % of rows identifiable"
        )
        if not each.scores:
            print(f"{heading}; too few to score {', '.join(found.entries)} by\n")
            continue
        families = ", ".join(each.families)
        heading += f", {each.people} of {found.people} people ({families})"
        wishes = any(math.isfinite(score.wish_rmse) for score in each.scores)
        header = (*_HEADER[:-2], f"wish, {each.unit}", *_HEADER[-2:]) if wishes else _HEADER
        emit_table(heading, header, [_row(score, wishes) for score in each.scores])
    if found.left_out:
        print(f"{found.left_out} of {found.people * found.worlds} walks could not be walked.")
    print(_NOTE)


def _row(score: EstimatorScore, wishes: bool) -> list[str]:
    found = [
        f"({score.name})" if score.reference else score.name,
        interval(score.rmse),
        _number(score.bias),
        _number(score.lag),
        interval(score.skill),
        _number(score.skill_all.value if score.skill_all else math.nan),
        _number(score.covered),
        interval(score.gap_closed),
        ", ".join(score.better_than) or "-",
    ]
    if wishes:
        found.insert(-2, _number(score.wish_rmse))
    if score.said < 0.995:
        found[0] += f", silent on {100.0 * (1.0 - score.said):.0f} %"
    return found


def _number(value: float) -> str:
    return f"{value:.2f}" if math.isfinite(value) else "-"


def as_plain(value: Any) -> Any:
    """Return dataclasses and named tuples as mappings, for JSON."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        items = {item.name: getattr(value, item.name) for item in dataclasses.fields(value)}
        return {name: as_plain(item) for name, item in items.items()}
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        return value._asdict()
    return [as_plain(item) for item in value] if isinstance(value, tuple) else value
