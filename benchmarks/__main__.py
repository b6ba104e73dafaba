"""Print measurements as tables: ``python -m benchmarks [SUBJECT ...]``, all without a subject."""

from __future__ import annotations

from argparse import ArgumentParser, RawDescriptionHelpFormatter
from functools import partial

from rich.console import Console
from rich.table import Table

from cowalk.sim.basics.registry import did_you_mean

from . import (
    closed_loop,
    contact_noise,
    environments,
    humans,
    imperfections,
    plant_options,
    sensing,
    shares,
    start_up,
    surroundings,
)

SUBJECTS = {
    "start": start_up.measure,
    "closed loop": closed_loop.measure,
    "walk": partial(closed_loop.measure, "walk", 80.0, 2.0),
    "walk on wheels": partial(closed_loop.measure, "walk", 80.0, 2.0, "wheels"),
    "shares of a walk": shares.measure,
    "plant options": plant_options.measure,
    "contact noise": contact_noise.measure,
    "environments": environments.measure,
    "human models": humans.measure,
    "imperfections": imperfections.measure,
    "force sensor": sensing.measure,
    "distances and sight": surroundings.measure,
}


def verdict(value: float, target: tuple[str, float]) -> tuple[str, str]:
    """Return a target, ``("at most" or "at least", limit)``, in words, and whether it is met."""
    side, limit = target
    met = value <= limit if side == "at most" else value >= limit
    return f"{side} {limit:g}", "met" if met else "missed"


def main() -> None:
    """Measure subjects and print a table each."""
    # A subject may hold blanks, and argparse breaks lines there; so one a line as it is.
    parser = ArgumentParser(
        prog="python -m benchmarks",
        description="Print measurements as tables, all of them without a subject.",
        epilog="subjects:\n" + "\n".join(f"  {name!r}" for name in SUBJECTS),
        formatter_class=RawDescriptionHelpFormatter,
    )
    parser.add_argument("subject", nargs="*", help="what to measure, in quotes")
    chosen = parser.parse_args().subject or list(SUBJECTS)
    if unknown := [name for name in chosen if name not in SUBJECTS]:
        parser.error(f"unknown subject {unknown[0]!r}; {did_you_mean(unknown[0], list(SUBJECTS))}")
    console = Console()
    for title in chosen:
        measure = SUBJECTS[title]
        rows = [(*row, None) if len(row) == 3 else row for row in measure()]
        judged = any(target for *_, target in rows)
        heads = ("measurement", "value", "unit", *(("target", "") if judged else ()))
        table = Table(*heads, title=title, title_justify="left")
        for what, value, unit, target in rows:
            table.add_row(what, f"{value:.3g}", unit, *(verdict(value, target) if target else ()))
        console.print(table)


if __name__ == "__main__":
    main()
