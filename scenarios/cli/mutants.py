"""The commands about parts that are bad on purpose: whether measures and expectations tell."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Annotated

import typer

from .changes import Changes, changing, load_changed, option
from .output import FAILED, PASSED, Json, emit_json, emit_table, progress_bar


def register(app: typer.Typer) -> None:
    """Add these commands to the command line."""
    mutants = typer.Typer(
        rich_markup_mode=None, help="Run parts that are bad on purpose: can the measures tell?"
    )
    mutants.command(
        epilog=(
            "\b\nExamples:\n"
            "  cowalk mutants metrics\n"
            "  cowalk mutants metrics doorway -n 5 --plant unicycle --json\n"
            "  cowalk mutants metrics --write docs/metrics.md\n\n\b\n"
            "Exit codes: 1 if a metric says something else than was stated of it."
        )
    )(changing(metrics))
    mutants.command(
        epilog=(
            "\b\nExamples:\n"
            "  cowalk mutants expectations\n"
            "  cowalk mutants expectations puddle my.scenario.yaml --json\n"
            "  cowalk mutants expectations --write docs/expectations.md\n\n\b\n"
            "Exit codes: 1 if an expectation fails as it is or never, or a parked robot passes."
        )
    )(changing(expectations))
    app.add_typer(mutants, name="mutants")


def metrics(
    changes: Changes,
    scenario: Annotated[
        str, typer.Argument(metavar="SCENARIO", help="Name in the library, or a YAML file.")
    ] = "puddle",
    people: Annotated[
        int, typer.Option("-n", metavar="PEOPLE", min=0, help="Drawn besides the scenario's.")
    ] = 6,
    write: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Also put the table between its marks in a document."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Tell what each metric says of six bad automations, beside what it must say."""
    from ..export.marked import marked_document
    from ..mutants.statement import statements
    from ..mutants.study import judge, mutate
    from ..mutants.table import HEADER, MARK, MEASURED, measured, stated, write_table

    loaded = load_changed(scenario, changes)
    if write is not None:
        with option("--write"):
            marked_document(write, MARK)
    with progress_bar("running") as progress:
        verdicts = judge(mutate(loaded, people, progress), loaded.plant.name)
    if write is not None:
        write_table(write, verdicts, loaded.name, loaded.plant.name, people)
    if as_json:
        said = statements(loaded.plant.name)
        emit_json(
            {
                "scenario": loaded.name,
                "plant": loaded.plant.name,
                "people": people + 1,
                "metrics": [
                    dataclasses.asdict(verdict)
                    | {"stated": dataclasses.asdict(said[verdict.metric])}
                    for verdict in verdicts
                ],
            }
        )
    else:
        rows = [(row[0], row[3], row[4], row[5]) for row in stated(loaded.plant.name)]
        emit_table("stated of each metric", ("metric", *HEADER[3:]), rows)
        emit_table(f"bad automations in {loaded.name}", MEASURED, measured(verdicts))
    return FAILED if any(verdict.wrong for verdict in verdicts) else PASSED


def expectations(
    changes: Changes,
    scenarios: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[SCENARIO]...", help="Names in the library, or YAML files; all of the library."
        ),
    ] = None,
    write: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Also put the tables between their marks in a document."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Tell which expectations fail with which bad automation or wrong human."""
    from ..export.marked import marked_document
    from ..files.shipped import scenario_library
    from ..mutants.trial_table import HEADER, MARK, rows, write_table
    from ..mutants.trials import examine

    loaded = [load_changed(name, changes) for name in scenarios or scenario_library()]
    if write is not None:
        with option("--write"):
            marked_document(write, MARK)
    with progress_bar("running") as progress:
        examined = examine(loaded, progress)
    if write is not None:
        write_table(write, examined)
    if as_json:
        emit_json(
            {"scenarios": [dataclasses.asdict(each) | {"faults": each.faults} for each in examined]}
        )
    else:
        for each in examined:
            emit_table(each.scenario, HEADER, rows(each))
        for each in examined:
            for fault in each.faults:
                print(f"{each.scenario}: {fault}")
    return FAILED if any(each.faults for each in examined) else PASSED
