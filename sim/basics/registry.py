"""Names for interchangeable parts: built in, added by entry points, or ``module:Class``."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any, Generic, TypeVar

from .errors import InputError
from .validators import require, require_text

T = TypeVar("T")


def nearest(name: str, known: list[str]) -> str | None:
    """Return the known name that another one was most likely meant to be, if there is any."""
    return next(iter(difflib.get_close_matches(name, known, n=1)), None)


def did_you_mean(name: str, known: list[str], suited: list[str] | None = None) -> str:
    """Return what would be right instead of a name, to stand after a semicolon or a colon.

    Only a ``suited`` name is proposed, if they are given; all known ones are listed.
    """
    near, names = nearest(name, known if suited is None else suited), ", ".join(known)
    return f"did you mean {near!r}? Known: {names}" if near else f"known: {names}"


@cache
def _installed(group: str) -> dict[str, str]:
    # Reading the metadata of all installed packages takes milliseconds.
    return {point.name: point.value for point in entry_points(group=group)}


class Registry(Generic[T]):
    """A set of named constructors of one kind of part.

    Parameters
    ----------
    kind : str
        What is registered, in one word; it appears in messages.
    built_in : mapping of str to str
        ``module:Class`` for every name that ships; nothing is imported before it is asked for.
    entry_point_group : str, optional
        Group of Python entry points that adds names.
    methods : tuple of str
        What a class must have to be of this kind.

    Raises
    ------
    InputError
        If one is no text, or no mapping or tuple of such.
    """

    def __init__(
        self,
        kind: str,
        built_in: Mapping[str, str],
        entry_point_group: str | None = None,
        methods: tuple[str, ...] = (),
    ) -> None:
        require_text("kind", kind)
        right = isinstance(built_in, Mapping)
        right = right and all(isinstance(item, str) for pair in built_in.items() for item in pair)
        require(right, "built_in", built_in, "a mapping of names to module:Class is expected")
        if entry_point_group is not None:
            require_text("entry_point_group", entry_point_group)
        right = isinstance(methods, tuple) and all(isinstance(name, str) for name in methods)
        require(right, "methods", methods, "names of methods are expected")
        self.kind = kind
        self._built_in = dict(built_in)
        self._group = entry_point_group
        self._methods = methods

    def _addresses(self) -> dict[str, str]:
        return self._built_in | (_installed(self._group) if self._group else {})

    def names(self) -> list[str]:
        """Return all registered names, sorted."""
        return sorted(self._addresses())

    def __iter__(self) -> Iterator[str]:
        return iter(self.names())

    def get(self, name: str) -> Callable[..., T]:
        """Return the constructor behind a name or a ``module:Class``.

        Raises
        ------
        InputError
            If the name is unknown, or the module or the class cannot be imported.
        """
        address = name if ":" in name else self._addresses().get(name)
        if address is None:
            raise InputError(f"unknown {self.kind} {name!r}; {did_you_mean(name, self.names())}")
        module_name, _, attribute = address.partition(":")
        here = str(Path.cwd())
        if ":" in name and here not in sys.path:
            sys.path.append(here)  # a user's file in the current folder, as with `python -m`
        try:
            part: Any = import_module(module_name)
            for step in attribute.split("."):
                part = getattr(part, step)
        except (ImportError, AttributeError, SyntaxError, ValueError) as error:
            raise InputError(f"{self.kind} {name!r} cannot be imported: {error}") from error
        if not callable(part):
            raise InputError(f"{self.kind} {name!r} is not a class")
        missing = [method for method in self._methods if not hasattr(part, method)]
        if isinstance(part, type) and missing:
            needs = ", ".join(self._methods)
            raise InputError(
                f"{self.kind} {name!r} has no method {missing[0]!r}; a {self.kind} needs {needs}"
            )
        return part  # type: ignore[no-any-return]
