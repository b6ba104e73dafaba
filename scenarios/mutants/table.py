"""The mutation table of metrics: what is stated of each, and what the runs say."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from ..export.marked import markdown_table, write_marked
from ..measures.definitions import definitions
from .statement import statements
from .study import AUTOMATIONS, Verdict

MARK = "mutants-metrics"
HEADER = ("metric", "unit", "equation", "worse", "worst of the bad", "cannot see")
MEASURED = ("metric", *AUTOMATIONS, "wrong")


def stated(plant: str) -> list[tuple[str, ...]]:
    """Return the rows of `HEADER`: every metric, and what is stated of it on a plant."""
    said = statements(plant)
    return [
        (
            name,
            definition.unit,
            definition.equation,
            definition.worse or "-",
            (said[name].worst or "-") if name in said else "-",
            (", ".join(said[name].blind) or "-") if name in said else "-",
        )
        for name, definition in definitions().items()
    ]


def measured(verdicts: Sequence[Verdict]) -> list[tuple[str, ...]]:
    """Return the rows of `MEASURED`: medians over people, and what was stated wrongly."""
    return [
        (
            verdict.metric,
            *(_shown(verdict, name) for name in AUTOMATIONS),
            "; ".join(verdict.wrong) or "-",
        )
        for verdict in verdicts
    ]


def _shown(verdict: Verdict, name: str) -> str:
    value = verdict.values[name]
    text = "-" if math.isnan(value) else "never" if math.isinf(value) else f"{value:.3g}"
    return f"{text} ◂" if name in verdict.worst else text


def write_table(
    file: Path, verdicts: Sequence[Verdict], scenario: str, plant: str, people: int
) -> None:
    """Put both tables between the marks of a Markdown document.

    Parameters
    ----------
    file : Path
        Holds the lines ``<!-- mutants-metrics -->`` and ``<!-- /mutants-metrics -->``.
    verdicts, scenario, plant, people
        What is shown, and what made it.

    Raises
    ------
    InputError
        See `cowalk.scenarios.export.marked.marked_document`.
    """
    caption = (
        f"Measured: scenario `{scenario}` on the {plant} plant, its own human and {people} people "
        f"more; medians over them, false concession with a human who lets go. ◂ is the worst."
    )
    tables = (
        markdown_table(HEADER, stated(plant)),
        caption,
        markdown_table(MEASURED[:-1], [row[:-1] for row in measured(verdicts)]),
    )
    write_marked(file, MARK, "\n\n".join(tables))
