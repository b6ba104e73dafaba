"""The commands that run many scenarios: the paper reproduced, parts of a kind compared."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from cowalk.sim.basics.registry import import_address

from ..files.parts import Part, parts
from .changes import Changes, changing, load_changed, option
from .output import FAILED, PASSED, Json, emit_json, emit_table, progress_bar


def register(app: typer.Typer) -> None:
    """Add these commands to the command line."""
    app.command(
        epilog=(
            "\b\nExamples:\n"
            "  cowalk paper\n"
            "  cowalk paper --out runs/paper\n"
            "  cowalk paper --calibrate --seed 1"
        )
    )(paper)
    compare = typer.Typer(rich_markup_mode=None, help="Compare all parts of a kind.")
    for part in parts():
        if part.compare:
            compare.command(
                name=part.plural,
                epilog=(
                    "\b\nExamples:\n"
                    f"  cowalk compare {part.plural}\n"
                    f"  cowalk compare {part.plural} puddle --plant unicycle -n 20 --json\n"
                    f"  cowalk compare {part.plural} --with mymodule:MyClass"
                ),
            )(changing(_comparing(part)))
    compare.callback()(lambda: None)
    app.add_typer(compare, name="compare")


def paper(
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Also draw the paper's figures there.")
    ] = None,
    calibrate: Annotated[
        bool, typer.Option("--calibrate", help="Search the constants that the paper leaves out.")
    ] = False,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the search.")] = 0,
    as_json: Json = False,
) -> int:
    """Print the paper's reported numbers beside ours."""
    from ..export.folder import writable_folder

    if out is not None:
        with option("--out"):
            writable_folder(out)
    found: list[str] = []
    if calibrate:
        from ..studies.calibration import calibrate as search
        from ..studies.calibration import overrides

        with progress_bar("calibrating") as progress:
            constants, rows = search(seed, progress)
        found = overrides(constants)
    else:
        from ..studies.paper import constants as inferred
        from ..studies.paper import reproduce

        constants, rows = inferred(), reproduce()
    files = []
    if out is not None:
        from ..studies.paper import draw

        files = [str(file) for file in draw(out, found)]
    if as_json:
        emit_json(
            {
                "rows": [dataclasses.asdict(row) for row in rows],
                "inferred": constants,
                "figures": files,
                "passed": all(row.passed for row in rows),
            }
        )
    else:
        _records("reported in the paper, and ours", rows)
        title = f"found with seed {seed}" if calibrate else "inferred: the paper does not print"
        emit_table(title, ("constant", "value"), constants.items())
        if found:
            print("to run them: cowalk run paper-open-loop", *(f"--set '{each}'" for each in found))
        for file in files:
            print(f"picture:  {file}")
    return PASSED if all(row.passed for row in rows) else FAILED


def _comparing(part: Part) -> Callable[..., int]:
    """Return the command that compares all parts of a kind."""

    def compare(
        changes: Changes,
        scenario: Annotated[
            str, typer.Argument(metavar="SCENARIO", help="Name in the library, or a YAML file.")
        ] = "puddle",
        own: Annotated[
            list[str] | None,
            typer.Option(
                "--with", metavar="MODULE:CLASS", help="One of your own as well; may be repeated."
            ),
        ] = None,
        seeds: Annotated[int, typer.Option("-n", metavar="SEEDS", min=1, help="Runs of each.")] = 5,
        as_json: Json = False,
    ) -> int:
        with option("--with"):
            for name in own or []:
                part.registry().get(name)
        loaded = load_changed(scenario, changes)
        with progress_bar("comparing") as progress:
            scores = import_address(part.compare)(loaded, part.kind, own or [], seeds, progress)
        if as_json:
            emit_json({"scenario": loaded.name, "scores": [dataclasses.asdict(s) for s in scores]})
        else:
            _records(f"{part.plural} in {loaded.name}", scores)
        return PASSED

    compare.__doc__ = f"Score every {part.kind} in a scenario, your own as well."
    return compare


def _records(title: str, records: Sequence[Any]) -> None:
    """Write a table of dataclass instances, a column each field."""
    names = [item.name for item in dataclasses.fields(records[0])]
    header = [name.replace("_", " ") for name in names]
    emit_table(title, header, [[getattr(record, name) for name in names] for record in records])
