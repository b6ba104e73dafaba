"""What a run gives: its trace, and what is said of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from cowalk.sim.plant.discs import PLAIN_BODIES
from cowalk.sim.world.outline import Outline

from .trace.samples import SampleTable
from .trace.trace import Trace

if TYPE_CHECKING:
    from .expect.verdict import Verdict
    from .files.schema import Scenario

LOST_FOOTING = "lost footing"
"""What a human who did is said to have, as an end of a run and beside one."""


@dataclass(repr=False)
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
    lost : list of str
        What could not be shown or written while it ran, and why, a line each.
    fault : str or None
        The traceback, if the run ended by a fault of cowalk's own.
    samples : SampleTable or None
        A row a force sample, if they were asked for.
    picture : callable, optional
        Returns the result's picture as PNG; notebooks show it.
    """

    scenario: Scenario
    trace: Trace
    summary: dict[str, Any]
    verdicts: list[Verdict] = field(default_factory=list)
    error: str | None = None
    outlines: dict[str, Outline] = field(default_factory=lambda: PLAIN_BODIES.outlines)
    samples: SampleTable | None = None
    lost: list[str] = field(default_factory=list)
    fault: str | None = field(default=None, repr=False)
    picture: Callable[[RunResult], bytes] | None = field(default=None, repr=False, compare=False)

    @property
    def passed(self) -> bool:
        """Whether the run went through and every expectation held."""
        return self.error is None and all(verdict.passed for verdict in self.verdicts)

    def __repr__(self) -> str:
        """Return in one line what was run and how it went, not all that is kept of it."""
        held = sum(verdict.passed for verdict in self.verdicts)
        what = f"{self.scenario.name}, seed {self.scenario.seed}"
        ended = f"aborted: {self.error}" if self.error else f"ended by {how_it_ended(self.summary)}"
        return f"<RunResult {what}: {ended}, {held} of {len(self.verdicts)} expectations hold>"

    def _repr_png_(self) -> bytes | None:
        """Return the picture that notebooks show for a result."""
        return None if self.picture is None else self.picture(self)


def how_it_ended(summary: dict[str, Any]) -> str:
    """Return how a run ended, in words, from its summary."""
    touched = summary.get("contact")
    if isinstance(touched, dict):
        return f"collision of the {touched['body']} with {touched['thing']}"
    end, lost = str(summary.get("end")), summary.get("footing_lost_s")
    return end if lost is None or end == LOST_FOOTING else f"{end}, {LOST_FOOTING} at {lost:.4g} s"
