"""What the checks of all kinds of parts share: finding faults, and naming each with its cure."""

from __future__ import annotations

import inspect
import pickle
import random
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from cowalk.sim.basics.errors import InputError, PartError
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.registry import marked_kind
from cowalk.sim.basics.validators import are_numbers, shown

Methods = Mapping[str, tuple[tuple[str, ...], str]]
"""Methods of a kind of part: the arguments they are called with, and how each is declared."""


class Broken(Exception):
    """A fault after which a check cannot go on."""


def raise_problems(part: Any, problems: list[str]) -> None:
    """Raise one `InputError` that lists all problems of a part, if there are any."""
    name = getattr(part, "__name__", type(part).__name__)
    if problems:
        raise InputError(f"{name}: " + "; ".join(problems))


def problems_of(part: Any, methods: Methods, examine: Callable[[Any], Iterator[str]]) -> list[str]:
    """Return every fault of a part, each once and with its cure.

    Parameters
    ----------
    part : object
        An instance, or a class or marked function that builds one without arguments.
    methods : mapping of str to ((str, ...), str)
        See `Methods`.
    examine : callable
        Yields the faults of an instance that has these methods; it may raise `Broken`.
    """
    if inspect.isabstract(part):
        missing = []
        for name in sorted(part.__abstractmethods__):
            arguments = ", ".join(inspect.signature(getattr(part, name)).parameters)
            missing.append(f"there is no method {name!r}: add {name}({arguments})")
        return missing
    if inspect.isclass(part) or marked_kind(part):
        try:
            part = part()
        except (Exception, SystemExit) as error:
            what = one_line(error)
            return [f"it cannot be built without arguments ({what}): check an instance of it"]
    problems = list(call_faults(part, methods))
    if problems:
        return problems
    found: dict[str, None] = {}
    with _global_state() as touched:
        try:
            for fault in examine(part):
                found[fault] = None
        except Broken as error:
            return [*found, str(error)]
        if touched():
            own = "draw from the rng that reset is given alone"
            found[f"it touches the global random state: {own}"] = None
    return list(found)


def one_line(error: BaseException) -> str:
    """Return kind and text of an error in one line."""
    return f"{type(error).__name__}: {' '.join(str(error).split())}".rstrip(": ")


def call_faults(part: Any, methods: Methods) -> Iterator[str]:
    """Yield which methods are missing, or cannot be called as a run calls them."""
    for name, (arguments, how) in methods.items():
        method = getattr(part, name, None)
        if not callable(method):
            yield f"there is no method {name!r}: add {how}"
            continue
        try:
            signature = inspect.signature(method)
        except (TypeError, ValueError):  # compiled: nothing is known of it
            continue
        try:
            signature.bind(*arguments)
        except TypeError:
            call = f"{name}({', '.join(arguments)})"
            yield f"{name}{signature} cannot be called as {call}: declare {how}"


def attempt(
    what: str,
    call: Callable[..., Any],
    *arguments: Any,
    hint: Callable[[Exception], str] = lambda error: "",
) -> Any:
    """Return what a method returns; raise `Broken` where it fails.

    Parameters
    ----------
    what : str
        What has failed then, for the message.
    call : callable
    *arguments
    hint : callable
        Gives what to add to the message about an error.
    """
    try:
        return call(*arguments)
    except PartError as error:
        raise Broken(f"{what}: {error}") from None
    except (Exception, SystemExit) as error:
        more = hint(error) if isinstance(error, Exception) else ""
        raise Broken(f"{what}: {one_line(error)}{more}") from None


def require_array(what: str, value: Any, shape: tuple[int, ...], cure: str) -> None:
    """Raise `Broken` unless a value is an array of numbers of a shape.

    Parameters
    ----------
    what : str
        What was returned where, for the message.
    value : object
    shape : tuple of int
    cure : str
        What to return instead.
    """
    if not isinstance(value, np.ndarray):
        raise Broken(f"{what} {shown(value)}, no NumPy array: {cure}")
    if value.shape != shape:
        raise Broken(f"{what} an array of shape {value.shape}: {cure}")
    if value.dtype.kind not in "fiu":
        raise Broken(f"{what} an array of {value.dtype} instead of numbers: {cure}")


class Kept:
    """Arrays that must stay as they are: what a part was given, and what it has returned."""

    def __init__(self) -> None:
        self._kept: list[tuple[str, Array, Array]] = []

    def keep(self, fault: str, array: Array) -> None:
        """Remember an array, and what it means if it changes."""
        self._kept.append((fault, array, array.copy()))

    def faults(self) -> Iterator[str]:
        """Yield the fault of every array that has changed."""
        for fault, now, then in self._kept:
            if not np.array_equal(now, then, equal_nan=True):
                yield fault


RETURNED = "changes an array that it returned before: return a fresh one"
"""What is wrong with a method that keeps one array and fills it anew."""


def repeat_faults(first: Array, others: list[Array], what: str, cure: str) -> Iterator[str]:
    """Yield whether outputs after equal resets differ.

    Parameters
    ----------
    first : ndarray, shape (steps, n)
    others : list of ndarray of that shape
    what : str
        What has been repeated, "two walks after equal resets".
    cure : str
    """
    # NaN is not equal to itself.
    same = [np.isclose(first, other, rtol=0.0, atol=0.0, equal_nan=True) for other in others]
    different = np.flatnonzero(~np.all(same, axis=(0, -1)))
    if different.size:
        yield f"{what} differ from step {different[0]} on: {cure}"


def generator_faults(part: Any, reset: Callable[[int], None], alike: str) -> Iterator[str]:
    """Yield which generators that a part keeps start alike, whatever reset is given.

    Parameters
    ----------
    part : object
        Has been used since it was reset.
    reset : callable
        Resets it with a generator of a seed.
    alike : str
        What is the same then for every seed.
    """
    drawn = _generators(part)
    starts = []
    for seed in (7, 8):
        reset(seed)
        starts.append(_generators(part))
    for name, start in starts[0].items():
        if start == starts[1].get(name) and start != drawn.get(name):
            yield (
                f"the generator self.{name} starts alike whatever rng reset is given, so that "
                f"every seed gives {alike}: self.{name} = rng in reset"
            )


def _generators(part: Any) -> dict[str, bytes]:
    """Return the states of the generators of random numbers that a part keeps, by attribute."""
    found = {}
    for name, value in getattr(part, "__dict__", {}).items():
        if isinstance(value, np.random.Generator):
            found[name] = pickle.dumps(value.bit_generator.state)
        elif isinstance(value, random.Random):
            found[name] = pickle.dumps(value.getstate())
    return found


@contextmanager
def _global_state() -> Iterator[Callable[[], bool]]:
    """Watch the global random state, and put it back: yield whether it has been touched."""
    # The global state is what is watched.
    legacy, plain = np.random.get_state(), random.getstate()  # noqa: NPY002

    def state() -> bytes:
        return pickle.dumps((np.random.get_state(), random.getstate()))  # noqa: NPY002

    np.random.random()  # noqa: NPY002 - where a part that seeds it would not put it
    random.random()
    before = state()
    try:
        yield lambda: state() != before
    finally:
        np.random.set_state(legacy)  # noqa: NPY002
        random.setstate(plain)


def column_faults(columns: Any) -> Iterator[str]:
    """Yield what is wrong with the ``columns`` of a part; raise `Broken` if it is no mapping."""
    if not isinstance(columns, Mapping):
        raise Broken(f"columns is {shown(columns)}: give units by name, {{'urgency': '1'}}")
    for name, unit in columns.items():
        if not (isinstance(name, str) and name and isinstance(unit, str)):
            yield f"columns has {name!r}: {unit!r}; give a name and its unit, {{'urgency': '1'}}"


def extra_faults(what: str, extras: Any, columns: Mapping[str, str]) -> Iterator[str]:
    """Yield which numbers that a part adds to the trace are not declared as columns.

    Raises
    ------
    Broken
        If they are no numbers by name.
    """
    if not isinstance(extras, Mapping):
        raise Broken(f"{what} is {shown(extras)}: give a number by name, {{'urgency': 0.5}}")
    for name, value in extras.items():
        if name not in columns:
            declared = ", ".join(columns) or "nothing"
            yield f"{what} has {name!r}, columns declares {declared}: add it there with its unit"
        if not are_numbers(value):
            raise Broken(f"{what}[{name!r}] is {shown(value)}: give one number")
