"""The commands about humans: draw people from a population, show a model, compare them all."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Annotated, Any

import typer

from ..files.parts import kind_of_part
from .changes import Changes, Trust, blamed, changing, load_changed, option
from .listing import list_parts
from .output import PASSED, Json, emit_json, emit_table, progress_bar
from .passing import who_passes


def register(app: typer.Typer) -> None:
    """Add these commands to the command line."""
    humans = typer.Typer(rich_markup_mode=None, help="Look at human models and populations.")

    @humans.command("list")
    def list_humans(as_json: Json = False) -> int:
        """List the human models."""
        return list_parts(kind_of_part("human").plural, as_json)

    humans.command(
        epilog=(
            "\b\nExamples:\n"
            "  cowalk humans sample healthy-adults -n 100\n"
            "  cowalk humans sample my.population.yaml -n 20 --seed 3 --json"
        )
    )(sample)
    humans.command(
        epilog=(
            "\b\nExamples:\n"
            "  cowalk humans show escalating\n"
            "  cowalk humans show steady --set human.parameters.level=[0.8,0.8]\n"
            "  cowalk humans show steady --imperfection reaction-delay --imperfection tremor\n"
            "  cowalk humans show --imperfection fatigue"
        )
    )(show)
    humans.command(
        epilog=(
            "\b\nExamples:\n"
            "  cowalk humans table\n"
            "  cowalk humans table puddle -n 10 --plant bullet\n"
            "  cowalk humans table --write docs/humans.md"
        )
    )(changing(table, plant="unicycle"))
    humans.command(
        "pass",
        epilog=(
            "\b\nExamples:\n"
            "  cowalk humans pass puddle\n"
            "  cowalk humans pass doorway --population frail-and-slow -n 100 --plant unicycle\n"
            "  cowalk humans pass puddle --against always-yields --against never-yields --json"
        ),
    )(changing(who_passes))
    app.add_typer(humans, name="humans")


def sample(
    population: Annotated[
        str, typer.Argument(metavar="POPULATION", help="Name of one that ships, or a YAML file.")
    ],
    count: Annotated[int, typer.Option("-n", metavar="PEOPLE", min=1, help="How many.")] = 10,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the draw.")] = 0,
    plant: Annotated[
        str, typer.Option(help="Plant they will walk on: what its body makes is left out.")
    ] = "unicycle",
    trust: Trust = False,
    as_json: Json = False,
) -> int:
    """Draw whole people from a population: how they decide, and the body they walk with."""
    from ..people.loading import load_population

    drawn = load_population(population, trust=trust).draw(count, seed, plant)
    if as_json:
        emit_json(
            {
                "population": population,
                "seed": seed,
                "plant": plant,
                "people": [
                    {
                        "kind": person.kind,
                        "human": person.human.model_dump(exclude_defaults=True),
                        "plant": person.plant,
                    }
                    for person in drawn
                ],
            }
        )
        return PASSED
    rows = [
        (
            str(number),
            person.kind or "-",
            *(_listed(person.plant.get(name, {})) for name in ("body", "gait", "walker")),
            person.human.name,
            _listed(person.human.parameters),
            _listed(person.human.model_dump(exclude_defaults=True).get("intention", {})),
            ", ".join(item.name for item in person.human.imperfections),
        )
        for number, person in enumerate(drawn, start=1)
    ]
    traits = ("body", "gait", "arm")
    header = ("", "kind", *traits, "model", "parameters", "intention", "imperfections")
    emit_table(f"{population}, seed {seed}", header, rows)
    return PASSED


def _listed(values: Any) -> str:
    """Return a section in one line, numbers to three digits."""
    if isinstance(values, dict):
        return ", ".join(f"{key} {_listed(value)}" for key, value in values.items())
    if isinstance(values, list | tuple):
        return f"[{', '.join(_listed(value) for value in values)}]"
    return f"{values:.3g}" if isinstance(values, float) else str(values)


def show(
    name: Annotated[
        str,
        typer.Argument(metavar="NAME", help="Model, or module:Class; none for --imperfection."),
    ] = "",
    imperfection: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Add an imperfection; may be repeated."),
    ] = None,
    assign: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="As in run: human.parameters.gain=3."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="PNG, runs/humans/NAME.png unless given.")
    ] = None,
    as_json: Json = False,
) -> int:
    """Draw what a human model does, or what an imperfection does."""
    from cowalk.sim.basics.errors import InputError

    from ..export.folder import writable_folder
    from ..studies.human_pictures import show_human, show_imperfections

    wanted = imperfection or []
    if not name and not wanted:
        raise InputError("name a human model, an --imperfection, or both; see cowalk list humans")
    file = out or Path("runs", "humans", "-".join([name, *wanted]).strip("-").replace(":", "."))
    if out is None or not file.suffix:
        file = file.with_name(f"{file.name}.png")
    elif file.suffix.lower() != ".png":
        raise InputError(f"--out {out}: pictures are PNG; write {file.with_suffix('.png')}")
    with option("--out"):
        writable_folder(file.parent)
    assignments = assign or []
    found: dict[str, Any]
    with blamed(Changes((), assignments)):
        if name:
            found = {"fixed points": show_human(name, wanted, assignments, file)}
        else:
            found = {"largest change": show_imperfections(wanted, assignments, file)}
    if as_json:
        emit_json({"human": name or None, "imperfections": wanted, "picture": str(file)} | found)
        return PASSED
    print(f"picture:  {file}")
    if name:
        for dimension, points in found["fixed points"].items():
            listed = ", ".join(f"{point:.2f}" for point in points) or "none"
            print(f"concession = stubbornness in {dimension} at: {listed}")
    return PASSED


def table(
    changes: Changes,
    scenario: Annotated[
        str, typer.Argument(metavar="SCENARIO", help="Name in the library, or a YAML file.")
    ] = "puddle",
    seeds: Annotated[int, typer.Option("-n", metavar="SEEDS", min=2, help="Runs of each.")] = 30,
    write: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Also put the table between its marks in a document."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Compare every human with every automation, with 95 % intervals."""
    from ..export.marked import marked_document
    from ..studies.human_table import (
        MARK,
        NOTE,
        compare_humans,
        header,
        row,
        write_table,
    )

    if write is not None:
        with option("--write"):
            marked_document(write, MARK)  # before the minutes that the runs take
    loaded = load_changed(scenario, changes)
    with progress_bar("comparing") as progress:
        cells = compare_humans(loaded, seeds, progress=progress)
    if write is not None:
        write_table(write, cells, loaded.name, loaded.plant.name, seeds)
    if as_json:
        emit_json(
            {
                "scenario": loaded.name,
                "plant": loaded.plant.name,
                "seeds": seeds,
                "note": NOTE,
                "cells": [
                    dataclasses.asdict(cell)
                    | {"metrics": {key: each._asdict() for key, each in cell.metrics.items()}}
                    for cell in cells
                ],
            }
        )
    else:
        emit_table(f"humans in {loaded.name}", header(), [row(cell) for cell in cells])
        print(NOTE)
    return PASSED
