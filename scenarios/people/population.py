"""Populations: distributions over human models and their parameters, drawn reproducibly."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from copy import deepcopy
from importlib.resources import files
from os import PathLike
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from cowalk.agents.humans.open_loop import OpenLoopHuman
from cowalk.agents.imperfections.wrapper import Imperfection
from cowalk.agents.registry import IMPERFECTIONS
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.registry import did_you_mean
from cowalk.sim.basics.validators import require
from cowalk.sim.plant.registry import PLANTS

from ..files.assembling import build_human, unsuited
from ..files.documents import Document, Fault, KeyPath, dotted
from ..files.loading import read_document
from ..files.overrides import expand_names
from ..files.schema import HumanComponent, human_model
from ..files.trust import code_named, untrusted
from ..files.validation import validate
from .distribution import KEY, Distribution

SUFFIX = ".population.yaml"
"""How the name of a population file ends."""
PROBABILITY = "probability"
"""Key of an imperfection that only some people have."""

_RATES = Rates()


class Group(BaseModel):
    """People who behave by one model: a human section in which any number may be drawn.

    Attributes
    ----------
    weight : float
        Share of the population, relative to the other groups.
    because : str
        The reason for the model.
    human : dict
        As in a scenario; a `Distribution` may stand for any number, and an imperfection may
        have a ``probability``.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    weight: Annotated[float, Field(gt=0.0)] = 1.0
    because: str = ""
    human: dict[str, Any]


class Population(BaseModel):
    """A distribution over humans."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str
    description: str = ""
    groups: Annotated[tuple[Group, ...], Field(min_length=1)]

    def draw(self, count: int, seed: int = 0, plant: str = "unicycle") -> list[HumanComponent]:
        """Return people, each a human section of a scenario.

        Every person has a generator of their own: the first ten of a hundred are the ten that
        are drawn alone.

        Parameters
        ----------
        count : int
            Number of people.
        seed : int
        plant : str
            Plant they will walk on; imperfections that its body makes by itself are left out.

        Raises
        ------
        InputError
            If the count or the seed is negative, or the plant is not known.
        """
        if count < 0 or seed < 0:
            what = f"count = {count}" if count < 0 else f"seed = {seed}"
            raise InputError(f"{what}: must not be negative")
        if plant not in PLANTS.names():
            PLANTS.get(plant)  # of one's own, or the message that it is not known
        weights = np.cumsum([group.weight for group in self.groups])
        laws = [_distributions(group.human) for group in self.groups]
        wrappers: dict[str, Callable[..., Imperfection]] = {
            item["name"]: IMPERFECTIONS.get(item["name"])
            for group in self.groups
            for item in group.human.get("imperfections") or []
        }
        people = []
        for sequence in np.random.SeedSequence(seed).spawn(count):
            rng = np.random.default_rng(sequence)
            index = int(np.searchsorted(weights, rng.random() * weights[-1], side="right"))
            drawn = _drawn(self.groups[index].human, laws[index], rng)
            drawn["imperfections"] = [
                item
                for item in drawn["imperfections"]
                if not unsuited(
                    wrappers[item["name"]](OpenLoopHuman(), **item.get("parameters", {})),
                    plant,
                    _RATES.period,
                )
            ]
            people.append(human_model().model_validate(drawn))
        return people


def _drawn(
    section: dict[str, Any], laws: dict[KeyPath, Distribution], rng: np.random.Generator
) -> dict[str, Any]:
    """Return a human section with every distribution drawn, in the order of the file."""
    values = {path: law.at(rng.random()) for path, law in laws.items()}
    human = _filled(section, values)
    present = [
        item
        for item in human.get("imperfections") or []
        if rng.random() < item.pop(PROBABILITY, 1.0)
    ]
    return human | {"imperfections": present}


def _distributions(section: Any) -> dict[KeyPath, Distribution]:
    return {path: Distribution(**value) for path, value in _nodes(section, ())}


def _nodes(value: Any, path: KeyPath) -> Iterator[tuple[KeyPath, dict[str, Any]]]:
    """Yield the path and the content of every distribution."""
    if isinstance(value, dict) and KEY in value:
        yield path, value
    elif isinstance(value, dict | list):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from _nodes(item, (*path, key))


def _filled(section: dict[str, Any], values: dict[KeyPath, float]) -> dict[str, Any]:
    """Return a copy of a section with values in the places of its distributions."""
    human = deepcopy(section)
    for path, value in values.items():
        place: Any = human
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = value
    return human


def population_library() -> dict[str, Path]:
    """Return the populations that ship: file by name."""
    folder = Path(str(files("cowalk.scenarios.populations")))
    return {file.name.removesuffix(SUFFIX): file for file in sorted(folder.glob(f"*{SUFFIX}"))}


def load_population(source: str | Path, *, trust: bool = False) -> Population:
    """Return a population, everything in it checked.

    Every distribution is tried at its smallest and at its largest value, the others at their
    medians: each human so made must build.

    Parameters
    ----------
    source : str or Path
        Name of one that ships, or path of a YAML file.
    trust : bool
        Whether code that the file names, ``module:Class``, may be imported.

    Raises
    ------
    InputError
        If the file is not right, or names code and is not trusted: the first fault, in one line.
    """
    known = population_library()
    what = "the name or the path of a population is expected"
    require(isinstance(source, str | PathLike), "population", source, what)
    file = known.get(str(source), Path(source))
    if not file.is_file():
        names = did_you_mean(str(source), list(known))
        raise InputError(f"unknown population {str(source)!r}; {names}, or the path of a YAML file")
    document = read_document(file)
    if fault := untrusted(file, document, _code_named(document.data), trust):
        raise InputError(f"{file}:{document.line(fault.path)}: {fault.message}")
    population, problems = _check(document)
    if problems or population is None:
        first = min(problems, key=lambda problem: document.line(problem.path))
        more = f" (+{len(problems) - 1} more)" if problems[1:] else ""
        raise InputError(f"{file}:{document.line(first.path)}: {first.message}{more}")
    return population


def _code_named(data: Any) -> list[tuple[KeyPath, str]]:
    groups = data.get("groups") if isinstance(data, dict) else None
    return [
        (("groups", index, *path), name)
        for index, group in enumerate(groups if isinstance(groups, list) else [])
        for path, name in code_named(group)
    ]


def _check(document: Document) -> tuple[Population | None, list[Fault]]:
    data = document.data
    if not isinstance(data, dict):
        what = "this holds no population; it needs the keys name and groups"
        return None, document.problems or [Fault((), what)]
    groups = data.get("groups")
    for group in groups if isinstance(groups, list) else []:
        expand_names(group)
    population, problems = validate(Population, data)
    problems += document.problems
    for index, group in enumerate(population.groups if population else ()):
        at: KeyPath = ("groups", index, "human")
        problems += [
            Fault((*at, *problem.path), f"groups.{index}.{problem.message}")
            for problem in _group_problems(group.human)
        ]
    return population, problems


def _group_problems(section: dict[str, Any]) -> list[Fault]:
    """Return what is wrong with a group's human, paths from its section on."""
    laws: dict[KeyPath, Distribution] = {}
    problems: list[Fault] = []
    for path, node in _nodes(section, ()):
        if path[-1:] in ((), ("name",)):
            what = (
                "a name is no number to draw; for several models, give each a group with a weight"
            )
            problems.append(Fault(path, f"{dotted(('human', *path))}: {what}"))
            continue
        law, faults = validate(Distribution, node, ("human", *path))
        problems += [Fault(fault.path[1:], fault.message) for fault in faults]
        if law is not None:
            laws[path] = law
    if problems:
        return problems
    medians = {path: law.at(0.5) for path, law in laws.items()}
    trials: list[tuple[KeyPath, dict[KeyPath, float]]] = [((), medians)]
    trials += [(path, medians | {path: end}) for path, law in laws.items() for end in law.ends]
    for path, values in trials:
        human = _filled(section, values)
        for index, item in enumerate(human.get("imperfections") or []):
            share = item.pop(PROBABILITY, 1.0) if isinstance(item, dict) else 1.0
            if not (isinstance(share, int | float) and 0.0 <= share <= 1.0):
                where = f"human.imperfections.{index}.{PROBABILITY}"
                path = ("imperfections", index, PROBABILITY)
                return [Fault(path, f"{where} = {share}: must lie in [0, 1]")]
        found = _human_problems(human)
        if found:
            return [Fault(path or found[0].path[1:], found[0].message)]
    return []


def _human_problems(section: dict[str, Any]) -> list[Fault]:
    """Return what keeps one human from being built, paths from ``human`` on."""
    component, problems = validate(human_model(), section, ("human",))
    if component is None:
        return problems
    try:
        build_human(component, "unicycle", _RATES.period)
    except InputError as error:
        return [Fault(error.at, str(error))]
    return []
