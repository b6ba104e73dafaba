"""Scenario files: found, read, checked once, and written back."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any

import yaml
from pydantic import BaseModel, ValidationError

from cowalk.agents.registry import AUTOMATIONS, HUMANS
from cowalk.estimation.smoothing import SMOOTHERS
from cowalk.sim.errors import InputError
from cowalk.sim.plants import PLANTS
from cowalk.sim.registry import Registry, did_you_mean

from .building import attempt, check_parameters
from .documents import Document, KeyPath, Problem, dotted, parse
from .overrides import component_sections, expand_names, override
from .results import UNITS
from .schema import SUFFIX, Component, Scenario
from .wording import validate

REGISTRIES: dict[str, Registry[Any]] = {
    "plant": PLANTS,
    "human": HUMANS,
    "automation": AUTOMATIONS,
    "automation.smoother": SMOOTHERS,
}
"""Where the components of each section are looked up."""

SHARED = {
    "plant": ("rates",),
    "human": ("intention",),
    "automation": ("negotiation", "smoother"),
    "automation.smoother": (),
}
"""Constructor arguments that come from elsewhere in the scenario."""


@dataclass(frozen=True)
class Fault:
    """Something wrong in a scenario file.

    Attributes
    ----------
    file : Path
    line : int
        From 1.
    key : str
        Dotted; empty where the file as a whole is meant.
    message : str
        Key, value and what would be right, in one line.
    """

    file: Path
    line: int
    key: str
    message: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.message}"


def library() -> dict[str, Path]:
    """Return the scenarios that ship: file by name."""
    folder = Path(str(files("cowalk.scenarios.library")))
    return {file.name.removesuffix(SUFFIX): file for file in sorted(folder.glob(f"*{SUFFIX}"))}


def find(source: str | Path) -> Path:
    """Return the file of a scenario given by its name in the library, or by its path.

    Raises
    ------
    InputError
        If there is none.
    """
    known = library()
    if isinstance(source, str) and source in known:
        return known[source]
    path = Path(source)
    if path.is_file():
        return path
    if path.suffix in (".yaml", ".yml") or len(path.parts) > 1:
        what = "is a folder" if path.is_dir() else "does not exist"
        raise InputError(f"{source}: this scenario file {what}; give the path of a YAML file")
    known_names = did_you_mean(str(source), list(known))
    raise InputError(f"unknown scenario {str(source)!r}; {known_names}, or the path of a YAML file")


def load(source: str | Path, overrides: Sequence[str] = ()) -> Scenario:
    """Return a scenario, everything in it checked.

    Parameters
    ----------
    source : str or Path
        Name in the library, or path of a YAML file.
    overrides : sequence of str
        ``dotted.key=VALUE``, the value in YAML, list entries by their index. A component set
        to a name alone is swapped (see `cowalk.scenarios.overrides.override`).

    Raises
    ------
    InputError
        If the file or an override is not right: the first fault, in one line.
    """
    file = find(source)
    document = _read(file)
    expand_names(document.data)
    overridden: dict[KeyPath, str] = {}
    if isinstance(document.data, dict) and not document.problems:
        for assignment in overrides:
            overridden[override(document.data, assignment)] = assignment
    scenario, problems = _check(document)
    if problems:
        first = min(problems, key=lambda problem: document.line(problem.path))
        where = next(
            (f"--set {text}" for path, text in overridden.items() if _touch(path, first.path)),
            f"{file}:{document.line(first.path)}",
        )
        more = f" (+{len(problems) - 1} more; see cowalk check {file})" if problems[1:] else ""
        raise InputError(f"{where}: {first.message}{more}")
    assert scenario is not None
    return scenario


def _touch(one: KeyPath, other: KeyPath) -> bool:
    shared = min(len(one), len(other))
    return bool(other) and one[:shared] == other[:shared]


def faults(file: str | Path) -> list[Fault]:
    """Return every fault of a scenario file, in the order of its lines; none if it is right.

    Raises
    ------
    InputError
        If the file cannot be read.
    """
    document = _read(Path(file))
    expand_names(document.data)
    found = [
        Fault(Path(file), document.line(problem.path), dotted(problem.path), problem.message)
        for problem in _check(document)[1]
    ]
    return sorted(found, key=lambda fault: fault.line)


def _read(file: Path) -> Document:
    try:
        return parse(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{file}: cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: this is not text in UTF-8; is it a YAML file?") from error


def _check(document: Document) -> tuple[Scenario | None, list[Problem]]:
    """Return the scenario of a document, or all of its problems."""
    if document.data is None and document.problems:
        return None, document.problems
    if not isinstance(document.data, dict):
        keys = ", ".join(name for name, item in Scenario.model_fields.items() if item.is_required())
        return None, [Problem((), f"this holds no scenario; it needs at least the keys {keys}")]
    scenario, problems = validate(Scenario, document.data)
    known = {problem.path for problem in problems}
    parts = (*_components(document.data, scenario), *_formulas(document.data, scenario))
    problems += [problem for problem in parts if problem.path not in known]
    problems += document.problems
    if scenario is not None:
        try:
            scenario.automation.negotiation.steps(scenario.rates.period)
        except InputError as error:
            problems.append(Problem(("automation", "negotiation", "period"), str(error)))
    return scenario, problems


def _components(data: dict[str, Any], scenario: Scenario | None) -> list[Problem]:
    """Return the problems of all named parts; they are built if everything around is right."""
    problems: list[Problem] = []
    for _, path, value in component_sections(data):
        section = ".".join(path)
        try:
            component = Component(name=value["name"], parameters=value.get("parameters") or {})
        except (ValidationError, TypeError, KeyError):
            continue  # reported as a fault of the schema already
        problems += check_parameters(REGISTRIES[section], component, section, SHARED[section])
    if not problems and scenario is not None:
        problems += _agents(scenario)
    return problems


def _agents(scenario: Scenario) -> list[Problem]:
    """Return why the agents cannot be built: a value that only its constructor can judge."""
    seat = scenario.automation
    _, human = attempt(HUMANS, scenario.human, "human", intention=scenario.human.intention)
    smoother, smoothing = attempt(SMOOTHERS, seat.smoother, "automation.smoother")
    _, automation = attempt(
        AUTOMATIONS, seat, "automation", negotiation=seat.negotiation, smoother=smoother
    )
    return [problem for problem in (human, smoothing, automation) if problem is not None]


def _formulas(data: dict[str, Any], scenario: Scenario | None) -> list[Problem]:
    """Return the problems of all expectations."""
    expect = data.get("expect")
    if not isinstance(expect, dict) or not expect:
        return []
    from .expectations import syntax_error

    period = scenario.rates.period if scenario else None
    found: list[Problem] = []
    for name, formula in expect.items():
        if isinstance(formula, str) and (reason := syntax_error(formula, UNITS, period)):
            found.append(Problem(("expect", name), f"expect.{name} = {formula!r}: {reason}"))
    return found


def to_yaml(scenario: Scenario) -> str:
    """Return a scenario as YAML that loads as an equal one, every default written out."""
    return yaml.safe_dump(
        _plain(scenario), sort_keys=False, allow_unicode=True, width=100, default_flow_style=None
    )


def _plain(value: Any) -> Any:
    """Return sections as mappings and tuples as lists, without what a section derives.

    No file holds an infinite number: a limit that is not there is left out.
    """
    if isinstance(value, BaseModel):
        return {name: _plain(getattr(value, name)) for name in type(value).model_fields}
    if dataclasses.is_dataclass(value):
        return {
            item.name: _plain(getattr(value, item.name))
            for item in dataclasses.fields(value)
            if item.init and getattr(value, item.name) != math.inf
        }
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value
