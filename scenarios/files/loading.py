"""Scenario files: found, read, checked once, and written back."""

from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import yaml
from pydantic import BaseModel

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.file_names import read_file, what_it_is
from cowalk.sim.basics.registry import did_you_mean
from cowalk.sim.basics.validators import require

from ..yaml_text.document import Document, KeyPath, dotted, parse
from ..yaml_text.loader import MOST_BYTES, knows_exponents
from .diagnosis import check
from .file_names import begin_paths_at
from .overrides import Change, Dropped, OverrideError, expand_names, override, parsed
from .schema import Scenario
from .shipped import scenario_library
from .trust import code_named, untrusted


@dataclass(frozen=True)
class FileFault:
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


def find(source: str | Path) -> Path:
    """Return the file of a scenario given by its name in the library, or by its path.

    Raises
    ------
    InputError
        If there is none, or it is neither name nor path.
    """
    known = scenario_library()
    what = "the name or the path of a scenario is expected"
    require(isinstance(source, str | PathLike), "scenario", source, what)
    if isinstance(source, str) and source in known:
        return known[source]
    path = Path(source)
    if os.path.isfile(path):  # pathlib fails at names too long
        return path
    if path.suffix in (".yaml", ".yml") or len(path.parts) > 1:
        what = what_it_is(path) or "does not exist"
        raise InputError(f"{source}: this scenario file {what}; give the path of a YAML file")
    known_names = did_you_mean(str(source), list(known))
    raise InputError(f"unknown scenario {str(source)!r}; {known_names}, or the path of a YAML file")


def load(source: str | Path, overrides: Sequence[str] = (), *, trust: bool = False) -> Scenario:
    """Return a scenario, everything in it checked.

    Parameters
    ----------
    source : str or Path
        Name in the library, or path of a YAML file. Relative paths in it begin where it lies.
    overrides : sequence of str
        ``dotted.key=VALUE``, the value in YAML, list entries by their index; relative paths
        begin in the working folder. A part set to another name is swapped
        (see `cowalk.scenarios.files.overrides.override`).
    trust : bool
        Whether code that the file names, ``module:Class``, may be imported: it can do
        whatever you can. What an override names may be.

    Raises
    ------
    InputError
        If the file or an override is not right, or the file names code and is not trusted:
        the first fault, in one line.
    """
    return read(source, overrides, trust=trust).scenario


@dataclass(frozen=True)
class Reading:
    """A scenario, and where what it says comes from.

    Attributes
    ----------
    scenario : Scenario
    given : dict
        "file" or "flag" by the place of every value that the file, or an override, gives.
    dropped : tuple of Dropped
        What went when a part was swapped.
    """

    scenario: Scenario
    given: dict[KeyPath, Literal["file", "flag"]]
    dropped: tuple[Dropped, ...]


def read(source: str | Path, overrides: Sequence[str] = (), *, trust: bool = False) -> Reading:
    """Return a scenario as `load` does, and where what it says comes from.

    Raises
    ------
    InputError
        See `load`; an `OverrideError` where an override is to blame.
    """
    file = find(source)
    document = read_document(file)
    expand_names(document.data)
    given: dict[KeyPath, Literal["file", "flag"]] = {}
    given |= {path: "file" for path, _ in leaves(document.data)}
    changes: list[Change] = []
    if isinstance(document.data, dict) and not document.problems:
        for number, assignment in enumerate(overrides):
            changes.append(override(document.data, assignment, number))
            expand_names(document.data)
            there = [path for path, _ in leaves(document.data)]
            given = {path: given[path] for path in there if path in given}
            for written in changes[-1].written:
                given |= {path: "flag" for path in there if path[: len(written)] == written}
    said = {name for each in overrides for name in _texts(parsed(each)[2])}
    if fault := untrusted(file, document, code_named(document.data), trust, said):
        raise InputError(f"{file}:{document.line(fault.path)}: {fault.message}")
    folder = file.resolve().parent
    begin_paths_at(folder, document.data, lambda place: given.get(place) == "file")
    scenario, problems = check(document)
    if problems:
        first = min(problems, key=lambda problem: document.line(problem.path))
        others = f"+{len(problems) - 1} more" if problems[1:] else ""
        blamed = [
            (len(change.path), number)
            for number, change in enumerate(changes)
            if _touch(change.path, first.path)
        ]
        if blamed:  # the one that says most exactly where
            number = max(blamed)[1]
            more = f" ({others})" if others else ""
            raise OverrideError(overrides[number], f"{first.message}{more}", number)
        more = f" ({others}; see cowalk check {file})" if others else ""
        raise InputError(f"{file}:{document.line(first.path)}: {first.message}{more}")
    assert scenario is not None
    return Reading(
        scenario,
        given,
        tuple(dropped for change in changes for dropped in change.dropped),
    )


def leaves(value: Any, path: KeyPath = ()) -> Iterator[tuple[KeyPath, Any]]:
    """Yield place and value of what is neither a section nor a list of them in plain data."""
    if isinstance(value, dict) and value:
        for key, item in value.items():
            yield from leaves(item, (*path, str(key)))
    elif isinstance(value, list) and any(isinstance(item, list | dict) for item in value):
        for index, item in enumerate(value):
            yield from leaves(item, (*path, index))
    else:
        yield path, value


def _texts(value: Any) -> set[str]:
    return {item for _, item in leaves(value) if isinstance(item, str)}


def _touch(one: KeyPath, other: KeyPath) -> bool:
    shared = min(len(one), len(other))
    return bool(other) and one[:shared] == other[:shared]


def faults(file: str | Path, *, trust: bool = False) -> list[FileFault]:
    """Return every fault of a scenario file, in the order of its lines; none if it is right.

    Parameters
    ----------
    file : str or Path
    trust : bool
        Whether code that the file names may be imported; otherwise, if it names some, that is
        all that is said of it.

    Raises
    ------
    InputError
        If the file cannot be read.
    """
    document = read_document(Path(file))
    expand_names(document.data)
    if fault := untrusted(Path(file), document, code_named(document.data), trust):
        problems = [fault]
    else:
        begin_paths_at(Path(file).resolve().parent, document.data, lambda place: True)
        problems = check(document)[1]
    found = [
        FileFault(Path(file), document.line(problem.path), dotted(problem.path), problem.message)
        for problem in problems
    ]
    return sorted(found, key=lambda fault: fault.line)


def read_document(file: Path) -> Document:
    """Return the document that a file holds.

    Raises
    ------
    InputError
        If the file cannot be read.
    """
    try:
        return parse(read_file(file, MOST_BYTES).decode("utf-8"))
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: this is not text in UTF-8; is it a YAML file?") from error


def to_yaml(scenario: Scenario, width: int = 100) -> str:
    """Return a scenario as YAML that loads as an equal one, every default written out."""
    text: str = yaml.dump(
        plain(scenario), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=width
    )
    return text


@knows_exponents
class _Dumper(yaml.SafeDumper):
    """Writes a list of plain values on one line, everything else on lines of its own."""


def _represent_list(dumper: yaml.SafeDumper, items: list[Any]) -> yaml.Node:
    flat = not any(isinstance(item, list | dict) for item in items)
    return dumper.represent_sequence("tag:yaml.org,2002:seq", items, flow_style=flat)


_Dumper.add_representer(list, _represent_list)


def plain(value: Any) -> Any:
    """Return sections as mappings and tuples as lists, without what a section derives.

    No file holds an infinite number: a limit that is not there is left out.
    """
    if isinstance(value, BaseModel):
        return {name: plain(getattr(value, name)) for name in type(value).model_fields}
    if dataclasses.is_dataclass(value):
        return {
            item.name: plain(getattr(value, item.name))
            for item in dataclasses.fields(value)
            if item.init and getattr(value, item.name) != math.inf
        }
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value
