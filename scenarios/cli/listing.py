"""The command that lists everything that has a name."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .output import PASSED, Json, emit_json, emit_table

if TYPE_CHECKING:
    from cowalk.sim.basics.registry import Registry


class Kind(StrEnum):
    """What `list` can list."""

    SCENARIOS = "scenarios"
    HUMANS = "humans"
    IMPERFECTIONS = "imperfections"
    POPULATIONS = "populations"
    AUTOMATIONS = "automations"
    SMOOTHERS = "smoothers"
    OBSERVERS = "observers"
    PLANTS = "plants"
    SENSORS = "sensors"


def register(app: typer.Typer) -> None:
    """Add this command to the command line."""
    app.command(name="list", epilog="\b\nExamples:\n  cowalk list\n  cowalk list humans --json")(
        list_parts
    )


def list_parts(
    kind: Annotated[Kind | None, typer.Argument(help="One kind alone.")] = None,
    as_json: Json = False,
) -> int:
    """List scenarios, humans, automations, sensors and everything else that has a name."""
    from cowalk.agents.registry import AUTOMATIONS, HUMANS, IMPERFECTIONS
    from cowalk.estimation.registry import OBSERVERS, SMOOTHERS
    from cowalk.sim.plant.registry import PLANTS
    from cowalk.sim.sensor.presets import PRESETS

    registries: dict[Kind, Registry[Any]] = {
        Kind.HUMANS: HUMANS,
        Kind.IMPERFECTIONS: IMPERFECTIONS,
        Kind.AUTOMATIONS: AUTOMATIONS,
        Kind.SMOOTHERS: SMOOTHERS,
        Kind.OBSERVERS: OBSERVERS,
        Kind.PLANTS: PLANTS,
    }
    found: dict[str, list[dict[str, str]]] = {}
    for each in [kind] if kind else Kind:
        if each in registries:
            described = _parts(registries[each])
        elif each is Kind.SENSORS:
            described = {name: text for name, (text, _) in PRESETS.items()}
        else:
            described = _files(each)
        found[each.value] = [{"name": n, "description": d} for n, d in described.items()]
    if as_json:
        emit_json(found)
    else:
        for name, entries in found.items():
            emit_table(name, ("name", "what it is"), [tuple(entry.values()) for entry in entries])
    return PASSED


def _files(kind: Kind) -> dict[str, str]:
    from ..files.documents import parse
    from ..files.loading import library
    from ..people.population import population_library

    known = library() if kind is Kind.SCENARIOS else population_library()
    data = {name: parse(file.read_text(encoding="utf-8")).data for name, file in known.items()}
    return {name: str(item.get("description", "")) for name, item in data.items()}


def _parts(registry: Registry[Any]) -> dict[str, str]:
    from cowalk.sim.basics.errors import InputError

    found = {}
    for name in registry:
        try:
            text = registry.get(name).__doc__ or ""
        except InputError as error:  # an installed add-on that does not work hides nothing else
            text = str(error)
        found[name] = text.strip().partition("\n")[0]
    return found
