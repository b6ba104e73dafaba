"""Names for interchangeable parts: built in, added by entry points, or ``module:Class``."""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any, Generic, TypeVar

from .errors import InputError
from .own_modules import named_module

T = TypeVar("T")
F = TypeVar("F", bound=Callable[..., Any])
_KIND = "__cowalk_part__"
"""Attribute of a function that says which kind of part it builds."""


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
def _all_installed() -> Any:
    # Slow to import, and reading the metadata of all packages takes milliseconds: once is enough.
    from importlib.metadata import entry_points

    return entry_points()


@cache
def _installed(group: str) -> dict[str, str]:
    return {point.name: point.value for point in _all_installed().select(group=group)}


def part(kind: str) -> Callable[[F], F]:
    """Mark a function as one that builds a part, so that ``module:function`` may name it.

    Parameters
    ----------
    kind : str
        Kind of the part, as `Registry.kind`: ``"human"``, ``"front end"``, ...

    Examples
    --------
    >>> @part("smoother")
    ... def wide(window: int = 20):
    ...     return MovingAverage(window)
    """

    def mark(function: F) -> F:
        setattr(function, _KIND, kind)
        return function

    return mark


def marked_kind(thing: Any) -> str | None:
    """Return the kind of part that a function is marked to build, None where it is not."""
    return None if isinstance(thing, type) else getattr(thing, _KIND, None)


def import_address(address: str) -> Any:
    """Return what ``module:name`` stands for.

    Raises
    ------
    InputError
        If it cannot be imported.
    """
    module_name, _, attribute = address.partition(":")
    try:
        found: Any = named_module(module_name)
        for step in attribute.split("."):
            found = getattr(found, step)
    except (ImportError, AttributeError, SyntaxError, ValueError) as error:
        raise InputError(f"cannot be imported: {error}") from error
    except SystemExit as error:  # a script, not a module: it must not end the command
        raise InputError("cannot be imported: importing it ends the program") from error
    except Exception as error:  # a user's module may raise anything
        raise InputError(f"cannot be imported: {type(error).__name__}: {error}") from error
    return found


class Registry(Generic[T]):
    """A set of named constructors of one kind of part.

    Parameters
    ----------
    kind : str
        What is registered, in a word or two; it appears in messages.
    built_in : mapping of str to str
        ``module:Class`` for every name that ships; nothing is imported before it is asked for.
    entry_point_group : str, optional
        Group of Python entry points that adds names.
    protocol : type, optional
        Class whose methods a class must have to be of this kind.

    Raises
    ------
    InputError
        If a name is no text, ``built_in`` no mapping of such, or the protocol no class.
    """

    def __init__(
        self,
        kind: str,
        built_in: Mapping[str, str],
        entry_point_group: str | None = None,
        protocol: type[Any] | None = None,
    ) -> None:
        # It imports numpy, which whoever asks for help need not wait for.
        from .validators import require, require_instance, require_text

        require_text("kind", kind)
        right = isinstance(built_in, Mapping)
        right = right and all(isinstance(item, str) for pair in built_in.items() for item in pair)
        require(right, "built_in", built_in, "a mapping of names to module:Class is expected")
        if entry_point_group is not None:
            require_text("entry_point_group", entry_point_group)
        if protocol is not None:
            require_instance("protocol", protocol, type, "a class")
        self.kind = kind
        self._built_in = dict(built_in)
        self._group = entry_point_group
        self.calls = _calls(protocol) if protocol else {}

    def _addresses(self) -> dict[str, str]:
        return self._built_in | (_installed(self._group) if self._group else {})

    def names(self) -> list[str]:
        """Return all registered names, sorted."""
        return sorted(self._addresses())

    def __iter__(self) -> Iterator[str]:
        return iter(self.names())

    def get(self, name: str) -> Callable[..., T]:
        """Return the constructor behind a name or a ``module:Class``.

        It is a class with the methods of this kind, or a function that is marked with `part`:
        nothing else is ever called because a file names it.

        Raises
        ------
        InputError
            If the name is unknown, cannot be imported, or stands for something else.
        """
        address = name if ":" in name else self._addresses().get(name)
        if address is None:
            raise InputError(f"unknown {self.kind} {name!r}; {did_you_mean(name, self.names())}")
        try:
            found = import_address(address)
        except InputError as error:
            raise InputError(f"{self.kind} {name!r} {error}") from error
        if reason := self.mismatch(found):
            raise InputError(f"{self.kind} {name!r} {reason}")
        return found  # type: ignore[no-any-return]

    def mismatch(self, found: Any) -> str | None:
        """Return why something is no constructor of this kind, None if it is one."""
        if isinstance(found, type):
            missing = [name for name in self.calls if not callable(getattr(found, name, None))]
            article = "an" if self.kind[0] in "aeiou" else "a"
            needs = f"{article} {self.kind} needs {', '.join(self.calls)}"
            return f"has no method {missing[0]!r}; {needs}" if missing else None
        marked = marked_kind(found)
        if marked is not None and marked != self.kind:
            return f"builds a part of another kind: {marked}"
        if marked is None and callable(found):
            return (
                f"is not a class; mark a function that builds one: @cowalk.sim.part({self.kind!r})"
            )
        return None if marked else "is not a class"

    def suits(self, found: Any) -> bool:
        """Return whether a class can be called as this kind is, or a function is marked so."""
        if not isinstance(found, type):
            return marked_kind(found) == self.kind
        return self.mismatch(found) is None and all(
            takes(getattr(found, name), len(given)) for name, given in self.calls.items()
        )

    def describe(self, name: str) -> str:
        """Return what a name stands for, in one line."""
        try:
            text = self.get(name).__doc__ or ""
        except InputError as error:  # an installed add-on that does not work hides nothing else
            text = str(error)
        return text.strip().partition("\n")[0]


def _calls(protocol: type[Any]) -> dict[str, tuple[str, ...]]:
    """Return the methods of a protocol, and the arguments that each is called with."""
    return {
        name: tuple(inspect.signature(method).parameters)[1:]
        for kind in reversed(protocol.__mro__)
        for name, method in vars(kind).items()
        if inspect.isfunction(method) and not name.startswith("_")
    }


def takes(method: Any, count: int) -> bool:
    """Return whether a method, looked up in its class, can be called with so many arguments."""
    own = 0 if inspect.ismethod(method) else 1
    try:
        inspect.signature(method).bind(*range(own + count))
    except TypeError:
        return False
    except ValueError:  # compiled: nothing is known of it
        return True
    return True
