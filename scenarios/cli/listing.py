"""The command that lists everything that has a name."""

from __future__ import annotations

from typing import Annotated

import typer

from ..files.parts import parts
from .output import PASSED, Json, emit_json, emit_table

FILES = ("scenarios", "populations")
"""What is listed besides the parts: files that ship."""


def register(app: typer.Typer) -> None:
    """Add this command to the command line."""
    command = app.command(
        name="list",
        help=f"List everything that has a name. Kinds: {', '.join(kinds())}.",
        epilog="\b\nExamples:\n  cowalk list\n  cowalk list humans --json",
    )
    command(list_parts)


def kinds() -> list[str]:
    """Return all that can be listed."""
    return [FILES[0], *(part.plural for part in parts()), *FILES[1:]]


def _known(kind: str) -> str:
    """Return a kind that can be listed, and refuse any other."""
    if kind and kind not in kinds():
        known = ", ".join(map(repr, kinds()))
        raise typer.BadParameter(f"{kind!r} is not one of {known}")
    return kind


def list_parts(
    kind: Annotated[
        str, typer.Argument(metavar="KIND", help="One kind alone.", callback=_known)
    ] = "",
    as_json: Json = False,
) -> int:
    """List everything that has a name."""
    rows = {part.plural: part for part in parts()}
    found: dict[str, list[dict[str, str]]] = {}
    for each in [kind] if kind else kinds():
        if each in rows:
            registry = rows[each].registry()
            described = {name: registry.describe(name) for name in registry.names()}
        else:
            described = _files(each)
        found[each] = [{"name": n, "description": d} for n, d in described.items()]
    if as_json:
        emit_json(found)
    else:
        for name, entries in found.items():
            emit_table(name, ("name", "what it is"), [tuple(entry.values()) for entry in entries])
    return PASSED


def _files(kind: str) -> dict[str, str]:
    from ..files.shipped import scenario_library
    from ..people.loading import population_library
    from ..yaml_text.document import parse

    known = scenario_library() if kind == FILES[0] else population_library()
    data = {name: parse(file.read_text(encoding="utf-8")).data for name, file in known.items()}
    return {name: str(item.get("description", "")) for name, item in data.items()}
