"""The one table of parts: a row for every kind of thing that a scenario names.

The schema of scenario files, overrides, checks, building, lists, summaries and the command line
all read it; a new kind of part is a new row. Nothing here imports a part, so that the command
line can ask the table for its options.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from cowalk.sim.basics.errors import Step
from cowalk.sim.basics.registry import import_address

NAME = "name"
PARAMETERS = "parameters"


class Names(Protocol):
    """What the table needs of a registry."""

    def names(self) -> list[str]:
        """Return all names."""
        ...

    def describe(self, name: str) -> str:
        """Return what a name stands for, in one line."""
        ...

    def get(self, name: str) -> Any:
        """Return what a name stands for."""
        ...


@dataclass(frozen=True)
class Part:
    """A kind of part.

    Parameters
    ----------
    kind, plural : str
        What one and several are called.
    section : tuple of str
        Where a scenario names it. A section beneath another part's is handed to the
        constructor of that part, under its last key.
    names : str
        Address of the registry in which it is looked up.
    model : str
        Address of the model of its section, without the parts beneath it. What the model
        holds besides name and parameters goes to the constructor.
    many : bool
        Whether the section is a list of such parts.
    wraps : str
        Given, each part of the list is built around the one before it, and the first around
        the part that holds the list: the constructor's argument for what is inside.
    default : str
        Name where a scenario gives none.
    given : tuple of str
        Keys of the scenario whose values its constructor takes.
    reserved : tuple of str
        Arguments of its constructor that no scenario sets.
    check : str
        Address of what lists the faults of a user's own class, each with its cure.
    compare : str
        Address of the study that runs all of the kind side by side.
    preset : bool
        Whether the name stands for values of the section itself, not for a class.
    """

    kind: str
    plural: str
    section: tuple[str, ...]
    names: str
    model: str = "cowalk.scenarios.files.schema:Component"
    many: bool = False
    wraps: str = ""
    default: str = ""
    given: tuple[str, ...] = ()
    reserved: tuple[str, ...] = ()
    check: str = ""
    compare: str = ""
    preset: bool = False

    @property
    def key(self) -> str:
        """Its key in the section around it."""
        return self.section[-1]

    @property
    def named_by(self) -> str:
        """Key of its section that holds the name."""
        return "preset" if self.preset else NAME

    @property
    def flag(self) -> str:
        """Word of the command-line option that swaps it; none for a list."""
        return "" if self.many else self.key.replace("_", "-")

    @property
    def title(self) -> str:
        """Its key in summaries."""
        return (self.plural if self.many else self.kind).replace(" ", "_")

    def registry(self) -> Names:
        """Return the registry in which it is looked up."""
        found: Names = import_address(self.names)
        return found

    def own_faults(self) -> Callable[[Any], list[str]] | None:
        """Return what lists the faults of a user's own class, if there is such a check."""
        return import_address(self.check) if self.check else None

    def children(self) -> tuple[Part, ...]:
        """Return the kinds of parts beneath this one."""
        return tuple(part for part in parts() if part.section[:-1] == self.section)


PARTS: tuple[Part, ...] = (
    Part(
        "human",
        "humans",
        ("human",),
        "cowalk.agents.registry:HUMANS",
        model="cowalk.scenarios.files.schema:HumanComponent",
        check="cowalk.agents.checks.conformance:human_problems",
        compare="cowalk.scenarios.studies.agents:compare_agents",
    ),
    Part(
        "imperfection",
        "imperfections",
        ("human", "imperfections"),
        "cowalk.agents.registry:IMPERFECTIONS",
        many=True,
        wraps="human",
        check="cowalk.agents.checks.imperfections:imperfection_problems",
    ),
    Part(
        "automation",
        "automations",
        ("automation",),
        "cowalk.agents.registry:AUTOMATIONS",
        model="cowalk.scenarios.files.schema:AutomationComponent",
        check="cowalk.agents.checks.conformance:automation_problems",
        compare="cowalk.scenarios.studies.agents:compare_agents",
    ),
    Part(
        "front end",
        "front-ends",
        ("automation", "front_end"),
        "cowalk.estimation.registry:FRONT_ENDS",
        check="cowalk.estimation.checks.front_ends:front_end_problems",
        compare="cowalk.scenarios.studies.estimators:compare_estimators",
        default="none",
    ),
    Part(
        "smoother",
        "smoothers",
        ("automation", "smoother"),
        "cowalk.estimation.registry:SMOOTHERS",
        check="cowalk.estimation.checks.smoothers:smoother_problems",
        compare="cowalk.scenarios.studies.estimators:compare_estimators",
        default="moving-average",
    ),
    Part(
        "observer",
        "observers",
        ("automation", "observer"),
        "cowalk.estimation.registry:OBSERVERS",
        check="cowalk.estimation.checks.observers:observer_problems",
        compare="cowalk.scenarios.studies.estimators:compare_estimators",
        default="paper",
    ),
    Part(
        "plant",
        "plants",
        ("plant",),
        "cowalk.sim.plant.registry:PLANTS",
        default="bullet",
        given=("rates",),
        reserved=("gui",),
    ),
    Part(
        "sensor preset",
        "sensors",
        ("sensor",),
        "cowalk.sim.sensor.presets:SENSOR_PRESETS",
        model="cowalk.sim.sensor.parameters:SensorParameters",
        preset=True,
    ),
)
"""All kinds of parts; what holds another comes before it."""


def parts() -> tuple[Part, ...]:
    """Return the table."""
    return PARTS


def roots() -> tuple[Part, ...]:
    """Return the kinds of parts that stand at the top of a scenario and are built."""
    return tuple(part for part in parts() if len(part.section) == 1 and not part.preset)


def kind_of_part(kind: str) -> Part:
    """Return the row of a kind."""
    return next(part for part in parts() if part.kind == kind)


def part_at(path: tuple[Step, ...]) -> Part | None:
    """Return the row of the part whose section lies at a path, entries of lists included."""
    steps = tuple(step for step in path if isinstance(step, str))
    listed = len(path) > len(steps)
    for part in parts():
        if part.section == steps and part.many == (listed and isinstance(path[-1], int)):
            return part
    return None
