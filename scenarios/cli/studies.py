"""The commands that run many scenarios: the paper reproduced, parts of a kind compared."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from cowalk.sim.basics.registry import import_address

from ..files.parts import Part, parts
from .changes import Changes, Population, changing, load_changed, option, refuse_humans
from .estimators import ESTIMATORS, as_plain, emit_estimators
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
                    f"  cowalk compare {part.plural} doorway --population determined -n 9\n"
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
    searched: dict[str, tuple[float, float]] = {}
    if calibrate:
        from ..studies.calibration import SEARCHED, overrides
        from ..studies.calibration import calibrate as search

        with progress_bar("calibrating") as progress:
            constants, rows = search(seed, progress)
        found, searched = overrides(constants), SEARCHED
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
                "searched": searched,
                "figures": files,
                "passed": all(row.passed for row in rows),
            }
        )
    else:
        _records("reported in the paper, and ours", rows)
        if calibrate:
            header = ("constant", "value", "searched from", "to")
            ranges = [(name, value, *searched[name]) for name, value in constants.items()]
            emit_table(f"found with seed {seed}", header, ranges)
            print("to run them: cowalk run paper-open-loop", *(f"--set '{each}'" for each in found))
        else:
            title = "inferred: the paper does not print"
            emit_table(title, ("constant", "value"), constants.items())
        for file in files:
            print(f"picture:  {file}")
    return PASSED if all(row.passed for row in rows) else FAILED


def _comparing(part: Part) -> Callable[..., int]:
    """Return the command that compares all parts of a kind."""
    estimates = part.kind in ESTIMATORS

    def compare(
        changes: Changes,
        scenario: Annotated[
            str, typer.Argument(metavar="SCENARIO", help="Name in the library, or a YAML file.")
        ] = "puddle",
        population: Population = "healthy-adults",
        own: Annotated[
            list[str] | None,
            typer.Option(
                "--with", metavar="MODULE:CLASS", help="One of your own as well; may be repeated."
            ),
        ] = None,
        people: Annotated[
            int,
            typer.Option(
                "-n", metavar="PEOPLE", min=2, help="How many; each walks in three worlds."
            ),
        ] = 20 if estimates else 6,
        as_json: Json = False,
    ) -> int:
        from ..people.loading import load_population

        refuse_humans(changes)
        with option("--with"):
            for name in own or []:
                part.registry().get(name)
        loaded = load_changed(scenario, changes)
        with option("--population"):
            drawn_from = load_population(population, trust=changes.trust)
        with progress_bar("walking") as progress:
            study = import_address(part.compare)
            found = study(loaded, part.kind, own or [], drawn_from, people, progress)
        if estimates:
            emit_json(as_plain(found)) if as_json else emit_estimators(found)
        elif as_json:
            said = {"scenario": loaded.name, "population": drawn_from.name, "people": people}
            emit_json(said | {"scores": [dataclasses.asdict(score) for score in found]})
        else:
            _records(f"{part.plural} in {loaded.name}, {people} {drawn_from.name}", found)
        return PASSED

    compare.__doc__ = (
        f"Score every {part.kind} on people who walk, your own as well."
        if estimates
        else f"Let people walk with every {part.kind}, your own as well."
    )
    return compare


def _records(title: str, records: Sequence[Any]) -> None:
    """Write a table of dataclass instances, a column each field."""
    names = [item.name for item in dataclasses.fields(records[0])]
    header = [name.replace("_", " ") for name in names]
    emit_table(title, header, [[getattr(record, name) for name in names] for record in records])
