"""Print every measurement as a table: ``python -m benchmarks``."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from . import closed_loop, humans, imperfections, sensing, surroundings

SUBJECTS = {
    "closed loop": closed_loop.measure,
    "human models": humans.measure,
    "imperfections": imperfections.measure,
    "force sensor": sensing.measure,
    "distances and sight": surroundings.measure,
}


def main() -> None:
    """Measure every subject and print a table each."""
    console = Console()
    for title, measure in SUBJECTS.items():
        table = Table("measurement", "value", "unit", title=title, title_justify="left")
        for what, value, unit in measure():
            table.add_row(what, f"{value:.3g}", unit)
        console.print(table)


if __name__ == "__main__":
    main()
