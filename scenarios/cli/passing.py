"""The command that counts who passes a scenario, and says why the others do not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from .changes import Changes, Population, load_changed, option, refuse_humans
from .output import PASSED, Json, emit_json, emit_table, interval, progress_bar

if TYPE_CHECKING:
    from ..studies.passing import Passes


def who_passes(
    changes: Changes,
    scenario: Annotated[
        str, typer.Argument(metavar="SCENARIO", help="Name in the library, or a YAML file.")
    ],
    population: Population = "healthy-adults",
    people: Annotated[int, typer.Option("-n", metavar="PEOPLE", min=2, help="How many.")] = 40,
    against: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Automation beside it; never-yields. Repeatable."),
    ] = None,
    as_json: Json = False,
) -> int:
    """Count the people who meet a scenario's expectations, with two automations side by side."""
    from ..people.loading import load_population
    from ..studies.passing import REFERENCE, people_who_pass

    refuse_humans(changes)
    loaded = load_changed(scenario, changes)
    with option("--population"):
        drawn_from = load_population(population, trust=changes.trust)
    automations = [loaded.automation.name, *(against or [REFERENCE])]
    with progress_bar("walking") as progress:
        found = people_who_pass(loaded, drawn_from, people, None, automations, progress)
    if as_json:
        emit_json(_as_json(found))
    else:
        _print(found)
    return PASSED


def _print(found: Passes) -> None:
    title = (
        f"{found.population} in {found.scenario} on {found.plant}: "
        f"{len(found.drawn)} people, seed {found.seed}"
    )
    names = [share.automation for share in found.shares]
    rows: list[tuple[Any, ...]] = [
        (
            share.automation,
            f"{share.passed} of {share.people}",
            interval(share.share),
            interval(found.differences.get(share.automation)),
        )
        for share in found.shares
    ]
    emit_table(title, ("automation", "pass", "share", f"{names[0]} has more by"), rows)
    expectations = [
        (name, *(share.failed[name] for share in found.shares)) for name in found.shares[0].failed
    ]
    emit_table("people for whom it did not hold", ("expectation", *names), expectations)
    ends = dict.fromkeys(end for share in found.shares for end in share.ends)
    counted = [(end, *(share.ends.get(end, 0) for share in found.shares)) for end in ends]
    emit_table("people by how their run ended", ("end", *names), counted)


def _as_json(found: Passes) -> dict[str, Any]:
    return {
        "scenario": found.scenario,
        "population": found.population,
        "plant": found.plant,
        "seed": found.seed,
        "automations": [
            {
                "automation": share.automation,
                "passed": share.passed,
                "people": share.people,
                "share": share.share._asdict(),
                "failed": share.failed,
                "ends": share.ends,
            }
            for share in found.shares
        ],
        "differences": {name: each._asdict() for name, each in found.differences.items()},
        "people": [
            {
                "kind": person.kind,
                "human": person.human.model_dump(exclude_defaults=True),
                "plant": person.plant,
                "outcomes": {
                    share.automation: share.outcomes[number]._asdict() for share in found.shares
                },
            }
            for number, person in enumerate(found.drawn)
        ],
    }
