"""What the command line shows: tables, progress, JSON, and errors of one line."""

from __future__ import annotations

import json
import math
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from typing import Annotated, Any, TextIO

import typer

PASSED, FAILED, BAD_INPUT, FAULT = 0, 1, 2, 3
"""Exit codes: all well, an expectation or verdict failed, bad input or an aborted run, a fault of
cowalk's own. One that a signal has ended has 128 and the signal's number, as usual."""
SIGNALLED = 128

Json = Annotated[bool, typer.Option("--json", help="JSON alone on standard output.")]
"""The option that every command with an answer has."""

LINE_EVERY = 10.0
"""Seconds between lines about progress where there is no terminal."""


_answers: TextIO | None = None
"""Where JSON goes; None means to standard output."""


def complain(message: str) -> None:
    """Write one line on standard error."""
    line = " ".join(message.split())
    # A file's text may hold what a terminal takes for a command.
    shown = "".join(sign if sign.isprintable() else "\N{REPLACEMENT CHARACTER}" for sign in line)
    with suppress(OSError):  # closed: there is nobody to tell
        print(f"cowalk: {shown}", file=sys.stderr)


def emit_json(value: Any) -> None:
    """Write a value as JSON on standard output; not-finite numbers become null."""
    from ..export.json_ready import json_ready

    text = json.dumps(json_ready(value), indent=2, allow_nan=False, ensure_ascii=False)
    print(text, file=_answers, flush=True)


@contextmanager
def json_alone(asked: bool) -> Iterator[None]:
    """Let nothing but `emit_json` reach standard output; what others print goes to standard error.

    That holds for what C code prints as well, and programs that are started.

    Parameters
    ----------
    asked : bool
        Whether to do so.
    """
    global _answers
    if not asked:
        yield
        return
    usual = sys.stdout
    usual.flush()
    output, error = 1, 2
    kept = os.dup(output)
    os.dup2(error, output)
    sys.stdout = sys.stderr
    try:
        with open(os.dup(kept), "w", encoding="utf-8", errors="backslashreplace") as _answers:
            yield
    finally:
        _answers, sys.stdout = None, usual
        os.dup2(kept, output)
        os.close(kept)


def settle_streams() -> None:
    """Let standard output and error be there, and take any text, as UTF-8.

    A file that is opened while one of them is closed would get its number, and with it whatever
    C code prints.
    """
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # the lowest number that is free
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")


def emit_table(title: str, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Write a table on standard output; numbers are set right, to four digits."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    cells = [list(row) for row in rows]
    table = Table(
        title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD, show_edge=False
    )
    for index, name in enumerate(header):
        numeric = any(isinstance(row[index], float) for row in cells)
        table.add_column(name, justify="right" if numeric else "left", overflow="fold")
    for row in cells:
        table.add_row(*(_text(cell) for cell in row))
    # Nothing is cut where the output is read by a program.
    console = Console(markup=False, width=None if sys.stdout.isatty() else 160)
    console.print(table)
    console.print()


def by_dimension(metrics: Mapping[str, Mapping[str, Any]]) -> list[tuple[Any, ...]]:
    """Return the rows of a table of metrics, one for all dimensions of each.

    Name, value of what has no dimension or of all together, of v or forward, of omega or
    sideways, unit.
    """
    places = {"v": 2, "forward": 2, "omega": 3, "sideways": 3}
    rows: dict[str, list[Any]] = {}
    for name, entry in metrics.items():
        family, _, dimension = name.rpartition(", ")
        if dimension not in places:
            family = name
        row = rows.setdefault(family, [family, "", "", "", entry["unit"]])
        row[places.get(dimension, 1)] = entry["value"]
        if row[4] != entry["unit"]:
            row[4] = f"{row[4]}, {entry['unit']}"
    return [tuple(row) for row in rows.values()]


def _text(cell: Any) -> str:
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    if cell is None or (isinstance(cell, float) and math.isnan(cell)):
        return "-"
    return f"{cell:.4g}" if isinstance(cell, float) else str(cell)


def two_digits(value: float) -> str:
    """Return a number with two significant digits and no exponent."""
    return f"{float(f'{value:.2g}'):g}"


def interval(found: tuple[float, float, float] | None) -> str:
    """Return a value with its interval as text: ``0.25 [0.14, 0.40]``; a dash for none."""
    if found is None:
        return "-"
    value, low, high = found
    return f"{value:.2f} [{low:.2f}, {high:.2f}]"


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """Yield a function of (done, total) that shows progress on standard error.

    On a terminal it is a bar; elsewhere a line now and then, so that a log of a short run has none.
    """
    if not sys.stderr.isatty():
        said = time.monotonic()

        def say(done: int, total: int) -> None:
            nonlocal said
            if time.monotonic() - said > LINE_EVERY:
                said = time.monotonic()
                print(f"cowalk: {what}: {100 * done // total} %", file=sys.stderr, flush=True)

        yield say
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what)
        yield lambda done, total: bar.update(task, completed=done, total=total)
