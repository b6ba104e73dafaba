"""How YAML is read: plain values alone, and no more of it than a scenario can hold.

What a text costs is counted from its events, before anything is built of them: nine aliases of
nine aliases, eight times over, are a few hundred bytes and fill any memory.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, TypeVar

import yaml
from yaml.constructor import ConstructorError

R = TypeVar("R", bound=yaml.resolver.BaseResolver)

MOST_BYTES = 1_000_000
MOST_NODES = 10_000
"""Values, keys, lists and sections of a document, aliases written out."""
DEEPEST = 50
"""Lists and sections within one another."""

EXPONENT = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)[eE][-+]?[0-9]+$")
"""Numbers such as 1e5 and 1.5e3, which YAML 1.2 knows and 1.1, that of PyYAML, takes for text."""
_KINDS = {
    "bool": "true or false",
    "int": "a whole number",
    "float": "a number",
    "timestamp": "a date",
    "binary": "binary data",
    "null": "null",
    "str": "text",
}
_PREFIX = "tag:yaml.org,2002:"


class TooMuchError(yaml.MarkedYAMLError):
    """A document holds more than any scenario does."""


def knows_exponents(kind: type[R]) -> type[R]:
    """Let a loader read what `EXPONENT` matches as numbers, or a dumper quote text like it."""
    kind.add_implicit_resolver("tag:yaml.org,2002:float", EXPONENT, list("-+.0123456789"))
    return kind


def reader(base: Any) -> Any:
    """Return a loader of PyYAML's that tells the line of whatever it cannot construct."""

    class Reader(base):  # type: ignore[misc]
        def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
            try:
                value = super().construct_object(node, deep)
                if isinstance(value, str):
                    value.encode()  # half a character cannot be
                return value
            except yaml.YAMLError:
                raise
            except Exception as error:  # int, float, datetime and chr raise what they like
                kind = str(node.tag).removeprefix(_PREFIX)
                text = str(node.value) if isinstance(node, yaml.ScalarNode) else "this"
                text = f"{text[:_SHOWN]!r}{'...' * bool(text[_SHOWN:])}"
                what = f"{text} cannot be read as {_KINDS.get(kind, kind)}"
                cure = "put it in quotes if it is text"
                raise ConstructorError(None, None, f"{what}; {cure}", node.start_mark) from error

    return knows_exponents(Reader)


# That of libyaml is ten times as fast; PyYAML comes with it nearly everywhere.
Loader = reader(getattr(yaml, "CSafeLoader", yaml.SafeLoader))
"""Reads scenario files, populations and the values of overrides."""

_SHOWN = 30
_TOO_DEEP = ", which no scenario or population is"
_TOO_MUCH = ": more than any scenario or population does"


def refuse_too_much(text: str) -> None:
    """Refuse a text that holds more than any scenario does, before anything is built of it.

    Raises
    ------
    TooMuchError
        With the line at which it became too much, or at which something contains itself.
    yaml.YAMLError
        If it is no YAML.
    """
    if len(text) > MOST_BYTES:
        what = f"it holds more than {MOST_BYTES:,} characters{_TOO_MUCH}"
        raise TooMuchError(None, None, what, None)
    total = 0
    sizes: dict[str, int] = {}
    open_: list[tuple[str | None, int]] = []
    for event in _events(text):
        mark: Any = event.start_mark  # libyaml's are of a type of their own
        if isinstance(event, yaml.CollectionEndEvent):
            anchor, before = open_.pop()
            if anchor is not None:
                sizes[anchor] = total - before + 1
            continue
        if isinstance(event, yaml.AliasEvent):
            if any(event.anchor == anchor for anchor, _ in open_):
                what = f"the alias *{event.anchor} stands in what it names, which contains itself"
                raise TooMuchError(None, None, what, mark)
            total += sizes.get(str(event.anchor), 1)
        elif isinstance(event, yaml.NodeEvent):
            total += 1
            if event.anchor is not None:
                sizes[event.anchor] = 1
        if isinstance(event, yaml.CollectionStartEvent):
            open_.append((event.anchor, total))
        if len(open_) > DEEPEST:
            what = f"lists and sections are nested more than {DEEPEST} deep{_TOO_DEEP}"
            raise TooMuchError(None, None, what, mark)
        if total > MOST_NODES:
            what = f"it holds more than {MOST_NODES:,} values, aliases written out{_TOO_MUCH}"
            raise TooMuchError(None, None, what, mark)


def _events(text: str) -> Iterator[Any]:
    loader = Loader(text)
    try:
        while loader.check_event():
            yield loader.get_event()
    except (OverflowError, ValueError) as error:  # a character beyond all, read without libyaml
        what = "a character is escaped that there is not"
        raise yaml.MarkedYAMLError(None, None, what, loader.get_mark()) from error
    finally:
        loader.dispose()
