"""YAML text as plain data that knows its lines, and reports what no scenario may hold."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any
from unicodedata import category

import yaml

from cowalk.sim.basics.errors import InputError, Step

from .loader import Loader, TooMuchError, refuse_too_much

KeyPath = tuple[Step, ...]
"""Where something stands in a document: keys and list indices from the top."""


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
    """Return the document that a YAML text holds; faults are reported in it, not raised.

    Keys that are no text become text, with a fault.
    """
    document = Document()
    try:
        refuse_too_much(text)
        loader = Loader(text)
        try:
            node = loader.get_single_node()
            if node is not None:
                _locate(node, (), document)
                document.data = loader.construct_document(node)
        finally:
            loader.dispose()
    except (yaml.YAMLError, RecursionError, OverflowError, ValueError) as error:
        mark = getattr(error, "problem_mark", None)
        document.data, document.lines = None, {(): mark.line + 1 if mark else 1}
        document.problems = [Fault((), _said(error, text))]
    return document


def _said(error: Exception, text: str) -> str:
    if isinstance(error, TooMuchError):
        return str(error.problem)
    return f"this is not YAML: {_reason(error, text)}"


def _reason(error: Exception, text: str) -> str:
    said = (str(getattr(error, "problem", None) or error).splitlines() or [""])[0]
    if "cannot start any token" in said:
        mark = getattr(error, "problem_mark", None)
        lines = text.splitlines()
        line = lines[mark.line] if mark and mark.line < len(lines) else ""
        if "\t" in line[: mark.column + 1 if mark else 0]:
            return "a tab stands where only spaces may; indent with spaces"
    if said.startswith("mapping values are not allowed"):
        return "a colon and a space within a value; put the value in quotes"
    if said == "but found another document":
        return "two documents, parted by ---, stand in it; one scenario or population may"
    if said.startswith("could not determine a constructor for the tag"):
        return f"{said.split()[-1]} is no tag that a scenario may hold; plain values only"
    return said if isinstance(error, yaml.YAMLError) else f"a value cannot be read ({said})"


def _locate(node: yaml.Node, path: KeyPath, document: Document) -> None:
    """Note the line of everything below a node; report keys given twice, and those no text."""
    document.lines.setdefault(path, node.start_mark.line + 1)
    if isinstance(node, yaml.SequenceNode):
        for index, item in enumerate(node.value):
            _locate(item, (*path, index), document)
    elif isinstance(node, yaml.MappingNode):
        first: dict[str, int] = {}
        for number, (key, value) in enumerate(node.value):
            line = key.start_mark.line + 1
            step = str(key.value) if isinstance(key, yaml.ScalarNode) else _ODD_KEY
            cure = "" if key.tag in _TEXTS else "put this key in quotes"
            if len(step) > _LONGEST_KEY:
                step, cure = f"{step[:_SHOWN]}...", f"a key has at most {_LONGEST_KEY} characters"
            place = (*path, step)
            document.lines[place] = line
            if cure:  # it goes on as text
                document.problems.append(Fault(place, f"{dotted(place)}: {cure}"))
                node.value[number] = yaml.ScalarNode(_TEXTS[0], step, key.start_mark), value
            elif step in first:
                message = f"{dotted(place)} is given twice, first in line {first[step]}"
                document.problems.append(Fault(place, message))
            first.setdefault(step, line)
            _locate(value, place, document)


_TEXTS = ("tag:yaml.org,2002:str", "tag:yaml.org,2002:merge")
_ODD_KEY = "?"
"""What a key is called that is a list or a section."""
_LONGEST_KEY = 200
_SHOWN = 40
"""Characters of a text in a message."""


def not_plain(value: Any, path: KeyPath = ()) -> list[Fault]:
    """Return everything in a value that no scenario holds.

    NaN, infinity, numbers too large, dates, keys that are no text, text that steers a terminal.
    """
    if isinstance(value, dict):
        problems = [
            Fault((*path, str(key)), f"{dotted((*path, str(key)))}: put this key in quotes")
            for key in value
            if not isinstance(key, str)
        ]
        problems += [
            Fault(path, f"{dotted(path)}: the key {key[:_SHOWN]!r} {_UNPRINTABLE}")
            for key in value
            if isinstance(key, str) and not _is_printable(key)
        ]
        return problems + [
            problem for key, item in value.items() for problem in not_plain(item, (*path, str(key)))
        ]
    if isinstance(value, list | tuple):
        return [problem for i, item in enumerate(value) for problem in not_plain(item, (*path, i))]
    if isinstance(value, float) and not math.isfinite(value):
        return [Fault(path, f"{dotted(path)} = {value}: a finite number is expected")]
    if isinstance(value, int) and abs(value) >= _LARGEST and path != _SEED:
        shown = f" = {value:.3g}" if abs(value) < _FLOAT else ""
        return [Fault(path, f"{dotted(path)}{shown}: must lie below 2^63, about 9.2e18")]
    if isinstance(value, str) and not _is_printable(value):
        return [Fault(path, f"{dotted(path)} = {value[:_SHOWN]!r}: it {_UNPRINTABLE}")]
    if value is not None and not isinstance(value, str | bool | int | float):
        kind = type(value).__name__
        what = f"{dotted(path)} = {value}: a {kind} is not expected; put it in quotes if it is text"
        return [Fault(path, what)]
    return []


_LARGEST, _FLOAT = 2**63, 10**300
_SEED = ("seed",)
"""Of any size: NumPy takes all."""
_UNPRINTABLE = "holds characters that cannot be shown; leave them out"
_TURNING = "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"


def _is_printable(text: str) -> bool:
    """Return whether a text can be shown: no control characters, none that turn its direction."""
    return text.isprintable() or not any(
        letter in _TURNING or (category(letter) in ("Cc", "Cs") and letter not in "\n\t")
        for letter in text
    )
