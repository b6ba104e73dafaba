"""The command that makes a run folder of what a run has left that was killed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .output import FAULT, PASSED, Json, emit_json


def register(app: typer.Typer) -> None:
    """Add this command to the command line."""
    app.command(
        epilog=(
            "\b\nExamples:\n  cowalk recover runs/puddle\n  cowalk recover runs/puddle/unfinished-1"
        )
    )(recover)


def recover(
    folder: Annotated[
        Path, typer.Argument(metavar="DIR", help="Run folder of a run that was killed.")
    ],
    as_json: Json = False,
) -> int:
    """Keep what a run has left that was killed: its trace, judged so far."""
    from ..running.recovery import recover_run

    result = recover_run(folder)
    if as_json:
        found = {"folder": str(folder), "complete": result is None}
        emit_json(found | ({} if result is None else result.summary))
    elif result is None:
        print(f"{folder}: the run was complete; its files are in place now")
    else:
        held = sum(verdict.passed for verdict in result.verdicts)
        print(f"{result.error}")
        print(f"rows:     {len(result.trace)}")
        print(f"expected: {held} of {len(result.verdicts)} hold so far")
        print(f"trace:    {folder / 'trace.parquet'}")
    return FAULT if result is not None and result.fault is not None else PASSED
