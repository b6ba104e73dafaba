"""The trace of a run, and the run folder that keeps it."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cowalk.sim.plant.discs import PLAIN_BODIES
from cowalk.sim.world.outline import Outline

from ..export.folder import writable_folder
from .trace import Trace

if TYPE_CHECKING:
    from ..expect.verdict import Verdict
    from ..files.schema import Scenario


@dataclass
class RunResult:
    """What a run leaves behind.

    Attributes
    ----------
    scenario : Scenario
        Fully resolved.
    trace : Trace
    summary : dict
        Metrics, versions, seed, wall time and real-time factor; JSON-ready.
    verdicts : list of Verdict
        One for each expectation of the scenario.
    error : str or None
        Why the run ended before its time, if it did.
    outlines : dict of str to Outline
        Of the bodies, for pictures; a load's in base axes, as it was held at the end.
    """

    scenario: Scenario
    trace: Trace
    summary: dict[str, Any]
    verdicts: list[Verdict] = field(default_factory=list)
    error: str | None = None
    outlines: dict[str, Outline] = field(default_factory=lambda: PLAIN_BODIES.outlines)

    @property
    def passed(self) -> bool:
        """Whether the run went through and every expectation held."""
        return self.error is None and all(verdict.passed for verdict in self.verdicts)

    def write(self, folder: str | Path) -> Path:
        """Write trace.parquet, summary.json, scenario.yaml and figure.png into a folder.

        Raises
        ------
        InputError
            If the folder cannot be written.
        """
        from ..figures.run import draw_run
        from ..files.assembling import resolve
        from ..files.loading import to_yaml

        folder = writable_folder(folder)
        self.trace.write(folder / "trace.parquet")
        (folder / "summary.json").write_text(json.dumps(self.summary, indent=2) + "\n")
        (folder / "scenario.yaml").write_text(to_yaml(resolve(self.scenario)))
        draw_run(self, folder / "figure.png")
        return folder


def how_it_ended(summary: dict[str, Any]) -> str:
    """Return how a run ended, in words, from its summary."""
    touched = summary.get("contact")
    if isinstance(touched, dict):
        return f"collision of the {touched['body']} with {touched['thing']}"
    return str(summary.get("end"))
