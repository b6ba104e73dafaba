"""The table of expectations and bad parts, on the screen and in a document."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..export.marked import markdown_table, write_marked
from .trials import PARTS, SHIPPED, Examined, Trial

MARK = "mutants-expectations"
HEADER = ("expectation", *PARTS)
END = "the run ends by"
SAME = "="
CAPTION = (
    "Six bad automations, then three wrong humans. = stands where all that is done is, bit for "
    "bit, as it is without them."
)


def rows(examined: Examined) -> list[tuple[str, ...]]:
    """Return the rows of `HEADER`: every expectation, and how the runs ended."""
    as_it_is = next(trial for trial in examined.trials if trial.part == SHIPPED)

    def cell(trial: Trial, name: str) -> str:
        held = trial.held[name]
        if trial.same and trial is not as_it_is and held == as_it_is.held[name]:
            return SAME
        return "holds" if held else "FAILS"

    judged = [(name, *(cell(trial, name) for trial in examined.trials)) for name in examined.expect]
    ends = (
        SAME if trial.same and trial is not as_it_is else trial.end.partition(" ")[0]
        for trial in examined.trials
    )
    return [*judged, (END, *ends)]


def write_table(file: Path, examined: Sequence[Examined]) -> None:
    """Put the tables of several scenarios between the marks of a Markdown document.

    Parameters
    ----------
    file : Path
        Holds the lines ``<!-- mutants-expectations -->`` and ``<!-- /mutants-expectations -->``.
    examined : sequence of Examined

    Raises
    ------
    InputError
        See `cowalk.scenarios.export.marked.marked_document`.
    """
    write_marked(file, MARK, markdown(examined))


def markdown(examined: Sequence[Examined]) -> str:
    """Return what stands between the marks."""
    parts = [CAPTION]
    for each in examined:
        parts += [f"**{each.scenario}**", markdown_table(HEADER, rows(each))]
    return "\n\n".join(parts)
