"""Tables that a command keeps up to date between two marks of a Markdown document."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from cowalk.sim.basics.errors import InputError


def markdown_table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table in Markdown; a bar within a cell does not end it."""
    from rich.box import MARKDOWN
    from rich.console import Console
    from rich.table import Table

    table = Table(box=MARKDOWN, show_edge=True)
    for name in header:
        table.add_column(name, no_wrap=True)
    for row in rows:
        table.add_row(*(cell.replace("|", "\\|") for cell in row))
    text = io.StringIO()
    Console(file=text, width=1000, markup=False, color_system=None).print(table)
    return "\n".join(line.rstrip() for line in text.getvalue().splitlines() if line.strip())


def marked_document(file: Path, mark: str) -> str:
    """Return the text of a document that has the lines ``<!-- mark -->`` and ``<!-- /mark -->``.

    Raises
    ------
    InputError
        If the file cannot be read or has no such marks.
    """
    try:
        document = file.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{file}: cannot be read ({error.strerror})") from error
    if not _place(mark).search(document):
        raise InputError(
            f"{file}: no place for the table; add the lines <!-- {mark} --> and <!-- /{mark} -->"
        )
    return document


def write_marked(file: Path, mark: str, text: str) -> None:
    """Put text between the marks of a document.

    Raises
    ------
    InputError
        See `marked_document`.
    """
    document = marked_document(file, mark)
    filled = _place(mark).sub(lambda found: f"{found[1]}{text}\n{found[2]}", document)
    file.write_text(filled, encoding="utf-8")


def _place(mark: str) -> re.Pattern[str]:
    return re.compile(rf"(<!-- {mark} -->\n).*?(<!-- /{mark} -->)", re.DOTALL)
