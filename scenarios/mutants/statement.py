"""What each metric must say of the bad automations: stated before they were run.

Where a run said otherwise, the metric was mended, or, where the statement had been wrong, that was
put right. A comment says where, and why.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Statement:
    """What is claimed of one metric.

    Attributes
    ----------
    worst : str or None
        The bad automation that comes out worst of the six, and worse than the paper's; empty
        where the metric does not apply, None where nothing is stated.
    blind : tuple of str
        Those that it cannot tell from the paper's automation, or takes for better ones.
    """

    worst: str | None
    blind: tuple[str, ...] = ("lies",)


# A parked base turns, slowly, where it is pulled by a handle beside it (its drive holds a speed,
# not a place), so that its human wants back: it is the worst of many in omega too. Stated was
# that these are blind to it, and that "jitters" or "never yields" would be the worst.
STATEMENTS: dict[str, Statement] = {
    "progress": Statement("parked", ("never yields", "lies")),
    "arrival time": Statement("parked", ("lies",)),
    # Stated was "always yields". Who is late swings past the path, too.
    "path error": Statement("late", ("parked", "never yields", "lies")),
    "smallest clearance": Statement("never yields", ("parked", "always yields", "lies")),
    "intended effort": Statement("parked"),
    "intended effort, forward": Statement("parked", ("never yields", "lies")),
    "intended effort, sideways": Statement("parked"),
    "squared intended effort, forward": Statement("parked", ("never yields", "lies")),
    "squared intended effort, sideways": Statement("parked"),
    "true effort": Statement("parked"),
    "true effort, forward": Statement("parked"),
    "true effort, sideways": Statement("parked"),
    "squared true effort, forward": Statement("parked"),
    "squared true effort, sideways": Statement("parked"),
    "intended effort a metre": Statement("parked"),
    # Stated was "always yields". By little, and it depends on the people: nothing is stated.
    "shaking, forward": Statement(None),
    "shaking, sideways": Statement("jitters", ("parked", "never yields", "lies")),
    "time apart, v": Statement("parked"),
    "time apart, omega": Statement("parked"),
    "disagreement, v": Statement("parked"),
    # Stated was "never yields". Who is late disagrees with a wish that has changed meanwhile.
    "disagreement, omega": Statement("late"),
    # It executes neither wish.
    "executed concession, v": Statement("parked"),
    "executed concession, omega": Statement("parked", ("always yields", "lies")),
    "false concession, v": Statement("parked"),
    "false concession, omega": Statement("always yields", ("never yields", "lies")),
    "conflict share, v": Statement("parked"),
    "conflict share, omega": Statement("parked"),
    "response lag, v": Statement(""),
    "response lag, omega": Statement("late", ("parked", "never yields", "lies")),
    "resolved in time, v": Statement("parked"),
    "resolved in time, omega": Statement("never yields", ("always yields", "lies")),
    "unresolved, v": Statement("parked"),
    "unresolved, omega": Statement("parked"),
    # Stated was "always yields". In gait's ripple they differ by little, and by the people.
    "log dimensionless jerk, v": Statement(None, ("parked", "never yields", "lies")),
    "log dimensionless jerk, omega": Statement("jitters", ("parked", "never yields", "lies")),
    "stubbornness RMSE, v": Statement("lies", ()),
    "stubbornness RMSE, omega": Statement("lies", ()),
    "stubbornness bias, v": Statement("lies", ()),
    "stubbornness bias, omega": Statement("lies", ()),
    "stubbornness coverage, v": Statement("lies", ()),
    "stubbornness coverage, omega": Statement("lies", ()),
    "smoothed stubbornness RMSE, v": Statement("lies", ()),
    "smoothed stubbornness RMSE, omega": Statement("lies", ()),
    "wish direction, v": Statement("lies", ()),
    "wish direction, omega": Statement("lies", ()),
}
"""By metric, where bodies walk (PyBullet)."""

_SIDEWAYS = (
    f"{size}{kind} effort, sideways" for size in ("", "squared ") for kind in ("intended", "true")
)
# There a parked base stands, and its human walks up to nothing; nor is it known what drives. Who
# costs most sideways, shakes most forward or has the jerkiest v depends on the people.
WITHOUT_BODIES = STATEMENTS | {
    **dict.fromkeys(_SIDEWAYS, Statement(None, ("parked", "lies"))),
    "shaking, forward": Statement(None),
    "log dimensionless jerk, v": Statement(None),
    "intended effort, forward": Statement("parked"),
    "squared intended effort, forward": Statement("parked"),
    "time apart, omega": Statement("jitters", ("parked", "never yields", "lies")),
    "executed concession, omega": Statement("never yields", ("always yields", "lies")),
    "conflict share, v": Statement(""),
    "conflict share, omega": Statement(""),
    "unresolved, omega": Statement("late", ("never yields", "lies")),
}
"""By metric, on the unicycle."""


def statements(plant: str) -> dict[str, Statement]:
    """Return the statement of each metric on a plant."""
    return WITHOUT_BODIES if plant == "unicycle" else STATEMENTS
