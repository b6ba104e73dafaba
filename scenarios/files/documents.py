"""YAML text as plain data that knows its lines, and reports what no scenario may hold."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import Any, TypeVar

import yaml

from cowalk.sim.basics.errors import InputError, Step

R = TypeVar("R", bound=yaml.resolver.BaseResolver)
KeyPath = tuple[Step, ...]
"""Where something stands in a document: keys and list indices from the top."""


EXPONENT = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)[eE][-+]?[0-9]+$")
"""Numbers such as 1e5 and 1.5e3, which YAML 1.2 knows and 1.1, that of PyYAML, takes for text."""


def knows_exponents(kind: type[R]) -> type[R]:
    """Let a loader read what `EXPONENT` matches as numbers, or a dumper quote text like it."""
    kind.add_implicit_resolver("tag:yaml.org,2002:float", EXPONENT, list("-+.0123456789"))
    return kind


@knows_exponents
class Loader(yaml.SafeLoader):
    """Reads scenario files, populations and the values of overrides."""


@dataclass(frozen=True)
class Fault:
    """Something wrong at a place of a document; the message is whole: key, value and cure."""

    path: KeyPath
    message: str

    def error(self) -> InputError:
        """Return it as an error at its place."""
        return InputError(self.message, self.path)


@dataclass
class Document:
    """What a YAML text holds.

    Attributes
    ----------
    data : object
        Plain data: mappings, lists, text, numbers, booleans and None.
    lines : dict
        Line, from 1, of every key and list entry.
    problems : list of Fault
        What is wrong with the text itself; ``data`` is None where it is no YAML at all.
    """

    data: Any = None
    lines: dict[KeyPath, int] = field(default_factory=dict)
    problems: list[Fault] = field(default_factory=list)

    def line(self, path: KeyPath) -> int:
        """Return the line of a place, or of the nearest thing around it that is there."""
        while path and path not in self.lines:
            path = path[:-1]
        return self.lines.get(path, 1)


def dotted(path: KeyPath) -> str:
    """Return a place as a user writes it: ``world.obstacles.0.x``."""
    return ".".join(str(step) for step in path)


def parse(text: str) -> Document:
    """Return the document that a YAML text holds; faults are reported in it, not raised."""
    document = Document()
    try:
        loader = Loader(text)
        node = loader.get_single_node()
        if node is not None and _locate(node, (), document, ()):
            document.data = loader.construct_document(node)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        document.lines = {(): mark.line + 1 if mark else 1}
        document.problems.append(Fault((), f"this is not YAML: {_reason(error)}"))
    return document


def _reason(error: yaml.YAMLError) -> str:
    problem = str(getattr(error, "problem", None) or error).splitlines()[0]
    if r"'\t'" in problem:
        return "a tab stands where only spaces may; indent with spaces"
    if problem == "mapping values are not allowed here":
        return "a colon and a space within a value; put the value in quotes"
    if problem.startswith("could not determine a constructor for the tag"):
        return f"{problem.split()[-1]} is no tag that a scenario may hold; plain values only"
    return problem


def _locate(
    node: yaml.Node, path: KeyPath, document: Document, around: tuple[yaml.Node, ...]
) -> bool:
    """Note the line of everything below a node, and report keys given twice.

    Returns
    -------
    bool
        False if something contains itself, so that there is no end to it.
    """
    document.lines.setdefault(path, node.start_mark.line + 1)
    if node in around:
        document.problems.append(Fault(path, f"{dotted(path)} contains itself"))
        return False
    finite = True
    if isinstance(node, yaml.SequenceNode):
        for index, item in enumerate(node.value):
            finite &= _locate(item, (*path, index), document, (*around, node))
    elif isinstance(node, yaml.MappingNode):
        first: dict[str, int] = {}
        for key, value in node.value:
            line = key.start_mark.line + 1
            place = (*path, str(key.value))
            if str(key.value) in first:
                message = f"{dotted(place)} is given twice, first in line {first[str(key.value)]}"
                document.problems.append(Fault(place, message))
            first.setdefault(str(key.value), line)
            document.lines[place] = line
            finite &= _locate(value, place, document, (*around, node))
    return finite


def not_plain(value: Any, path: KeyPath = ()) -> list[Fault]:
    """Return everything in a value that no scenario holds: NaN, infinity, dates, odd keys."""
    if isinstance(value, dict):
        problems = [
            Fault((*path, str(key)), f"{dotted((*path, str(key)))}: put this key in quotes")
            for key in value
            if not isinstance(key, str)
        ]
        return problems + [
            problem for key, item in value.items() for problem in not_plain(item, (*path, str(key)))
        ]
    if isinstance(value, list | tuple):
        return [problem for i, item in enumerate(value) for problem in not_plain(item, (*path, i))]
    if isinstance(value, float) and not math.isfinite(value):
        return [Fault(path, f"{dotted(path)} = {value}: a finite number is expected")]
    if value is not None and not isinstance(value, str | bool | int | float):
        kind = type(value).__name__
        what = f"{dotted(path)} = {value}: a {kind} is not expected; put it in quotes if it is text"
        return [Fault(path, what)]
    return []
