"""Population files: found, read, and checked before anybody is drawn."""

from __future__ import annotations

import os
from importlib.resources import files
from os import PathLike
from pathlib import Path
from typing import Any

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.registry import did_you_mean
from cowalk.sim.basics.validators import require

from ..files.assembling import build_human
from ..files.file_names import begin_paths_at
from ..files.loading import read_document
from ..files.overrides import expand_names
from ..files.schema import human_model
from ..files.trust import code_named, untrusted
from ..files.validation import validate
from ..yaml_text.document import Document, Fault, KeyPath, dotted
from .population import GAIT_RIPPLE, PROBABILITY, Group, Population
from .sections import read_distributions, try_ends
from .traits import faults_of_traits

SUFFIX = ".population.yaml"
"""How the name of a population file ends."""

_RATES = Rates()


def population_library() -> dict[str, Path]:
    """Return the populations that ship: file by name."""
    folder = Path(str(files("cowalk.scenarios.populations")))
    return {file.name.removesuffix(SUFFIX): file for file in sorted(folder.glob(f"*{SUFFIX}"))}


def load_population(source: str | Path, *, trust: bool = False) -> Population:
    """Return a population, everything in it checked.

    Every distribution is tried at its smallest and at its largest value, the others at their
    medians: each person so made must build.

    Parameters
    ----------
    source : str or Path
        Name of one that ships, or path of a YAML file. Relative paths in it begin where it lies.
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
    if not os.path.isfile(file):
        names = did_you_mean(str(source), list(known))
        raise InputError(f"unknown population {str(source)!r}; {names}, or the path of a YAML file")
    document = read_document(file)
    if fault := untrusted(file, document, _code_named(document.data), trust):
        raise InputError(f"{file}:{document.line(fault.path)}: {fault.message}")
    population, problems = _check(document, file.resolve().parent)
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


def _check(document: Document, folder: Path) -> tuple[Population | None, list[Fault]]:
    data = document.data
    if not isinstance(data, dict):
        what = "this holds no population; it needs the keys name and groups"
        return None, document.problems or [Fault((), what)]
    groups = data.get("groups")
    for group in groups if isinstance(groups, list) else []:
        expand_names(group)
        begin_paths_at(folder, group, lambda place: True)
    population, problems = validate(Population, data)
    problems += document.problems
    if population is None:
        return None, problems
    for index, traits in enumerate(population.people):
        problems += faults_of_traits(traits, ("people", index))
    walks = any(traits.gait for traits in population.people)
    for index, each in enumerate(population.groups):
        problems += _faults_of_group(each, ("groups", index, "human"), walks)
    return population, problems


def _faults_of_group(group: Group, at: KeyPath, walks: bool) -> list[Fault]:
    """Return what is wrong with a group's human, which stands at a place of the file."""
    section = group.human
    laws, problems = read_distributions(section, at)
    if problems:
        return problems
    for index, item in _imperfections(section):
        place: KeyPath = (*at, "imperfections", index)
        if walks and item.get("name") == GAIT_RIPPLE:
            what = "people have a gait of their own, people.gait, on every plant; leave this out"
            return [Fault(place, f"{dotted(place)} = {GAIT_RIPPLE!r}: {what}")]
        share = item.get(PROBABILITY, 1.0)
        if not (isinstance(share, int | float) and 0.0 <= share <= 1.0):
            place = (*place, PROBABILITY)
            return [Fault(place, f"{dotted(place)} = {share}: must lie in [0, 1]")]
    return try_ends(section, laws, at, lambda tried: _faults_of_human(tried, at))


def _imperfections(section: dict[str, Any]) -> list[tuple[int, dict[str, Any]]]:
    """Return number and section of each imperfection; whatever is none is refused later."""
    listed = section.get("imperfections")
    items = enumerate(listed if isinstance(listed, list) else [])
    return [(index, item) for index, item in items if isinstance(item, dict)]


def _faults_of_human(section: dict[str, Any], at: KeyPath) -> list[Fault]:
    """Return what keeps one human from being built."""
    for _, item in _imperfections(section):
        item.pop(PROBABILITY, None)
    component, problems = validate(human_model(), section, at)
    if component is None:
        return problems
    try:
        build_human(component, "unicycle", _RATES.period)
    except InputError as error:
        # It names its place in a scenario, from ``human`` on.
        return [Fault((*at, *error.at[1:]), f"{dotted(at[:-1])}.{error}")]
    return []
