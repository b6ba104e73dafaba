"""The options that change a scenario: one for every part of the table, ``--set`` and ``--seed``."""

from __future__ import annotations

import inspect
import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..files.parts import Part, parts
from .output import complain

if TYPE_CHECKING:
    from ..files.loading import Reading
    from ..files.schema import Scenario


@dataclass(frozen=True)
class Changes:
    """What the command line changes about a scenario.

    Attributes
    ----------
    names : sequence of (str, str, str or int)
        Option, key of the scenario and value, for every option that was given.
    assignments : sequence of str
        Values of ``--set``.
    trust : bool
        Whether code that the scenario's file names may be imported.
    """

    names: Sequence[tuple[str, str, str | int]]
    assignments: Sequence[str]
    trust: bool = False

    def __iter__(self) -> Iterator[tuple[str, str]]:
        """Yield how each change was written, and as an assignment."""
        for option, key, value in self.names:
            yield f"{option} {value}", f"{key}={json.dumps(value)}"  # text, whatever it says
        for assignment in self.assignments:
            yield f"--set {assignment}", assignment


def flagged() -> tuple[Part, ...]:
    """Return the kinds of parts that an option swaps."""
    return tuple(part for part in parts() if part.flag)


def changing(command: Callable[..., int], **usual: str) -> Callable[..., int]:
    """Return a command with these options in the place of its parameter ``changes``.

    Parameters
    ----------
    command : callable
        Takes ``changes``, a `Changes`.
    **usual
        Names that options have unless they are given, by the keys of their parts.
    """
    swaps = flagged()

    def called(assign: list[str] | None, seed: int | None, trust: bool, **given: Any) -> int:
        names = [(f"--{part.flag}", ".".join(part.section), given.pop(part.key)) for part in swaps]
        names = [each for each in names if each[2] is not None]
        names += [] if seed is None else [("--seed", "seed", seed)]
        changes = Changes(names, assign or [], trust)
        return command(changes=changes, **given)

    signature = inspect.signature(command, eval_str=True)
    parameters: list[inspect.Parameter] = []
    for parameter in signature.parameters.values():
        if parameter.name == "changes":
            parameters += [_option(part, usual.get(part.key)) for part in swaps]
            parameters += [_keyword("assign", _SET, None), _keyword("seed", _SEED, None)]
            parameters.append(_keyword("trust", Trust, False))
        else:
            parameters.append(parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY))
    called.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
    called.__annotations__ = {}
    called.__name__, called.__doc__ = command.__name__, command.__doc__
    return called


_SET = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Set one value, or merge a mapping (KEY:=VALUE replaces it); repeatable.",
    ),
]
Trust = Annotated[
    bool,
    typer.Option("--trust", help="Import code that the file names; see docs/security.md."),
]
"""The option of every command that reads a file which may name code."""
Population = Annotated[
    str, typer.Option("--population", metavar="NAME", help="One that ships, or a YAML file.")
]
"""The option of every command in which people of a population walk."""
_SEED = Annotated[int | None, typer.Option("--seed", help="Seed instead of the scenario's.")]


def _option(part: Part, usual: str | None) -> inspect.Parameter:
    what = "a name" if part.preset else "name or module:Class"
    text = f"{part.kind.capitalize()} instead of the scenario's: {what}."
    return _keyword(
        part.key, Annotated[str | None, typer.Option(f"--{part.flag}", help=text)], usual
    )


def _keyword(name: str, annotation: Any, default: Any) -> inspect.Parameter:
    return inspect.Parameter(
        name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation
    )


def load_changed(source: str, changes: Changes) -> Scenario:
    """Return a scenario with its changes (see `read_changed`)."""
    return read_changed(source, changes).scenario


def read_changed(source: str, changes: Changes) -> Reading:
    """Return a scenario with its changes; what a swapped part loses goes to standard error.

    Raises
    ------
    InputError
        If the scenario, or an option, is not right: the option is named.
    """
    from ..files.loading import read

    with blamed(changes):
        _refuse_contradictions(changes)
        reading = read(source, [assignment for _, assignment in changes], trust=changes.trust)
    for dropped in reading.dropped:
        complain(str(dropped))
    return reading


@contextmanager
def blamed(changes: Changes) -> Iterator[None]:
    """Tell what is wrong with an override in the words of its option."""
    from cowalk.sim.basics.errors import InputError

    from ..files.overrides import OverrideError

    try:
        yield
    except OverrideError as error:
        written, _ = list(changes)[error.number]
        raise InputError(f"{written}: {error.reason}") from error


@contextmanager
def option(name: str) -> Iterator[None]:
    """Let errors name the option whose value is wrong."""
    from cowalk.sim.basics.errors import InputError

    try:
        yield
    except InputError as error:
        raise InputError(f"{name} {error}") from error


_OWN = ("human.name", "human.parameters", "human.imperfections")
"""Keys of the human seat that people of a population bring along."""


def refuse_humans(changes: Changes) -> None:
    """Refuse changes of what people of a population bring along."""
    from cowalk.sim.basics.errors import InputError

    for written, assignment in changes:
        key = assignment.partition("=")[0].removesuffix(":")
        if key == "human" or key.startswith(_OWN):
            what = "people of a population bring their own; only human.intention can be set here"
            raise InputError(f"{written}: {what}")


def _refuse_contradictions(changes: Changes) -> None:
    """Refuse an option and a ``--set`` of the same key that say two things."""
    from cowalk.sim.basics.errors import InputError

    from ..files.overrides import parsed

    said: dict[tuple[str | int, ...], tuple[str, str | int]] = {
        tuple(key.split(".")): (f"{name} {value}", value) for name, key, value in changes.names
    }
    named: dict[tuple[str | int, ...], str] = {
        part.section: part.named_by for part in parts() if part.section in said
    }
    said |= {(*section, name): said[section] for section, name in named.items()}
    for number, (written, assignment) in enumerate(changes):
        steps, _, value = parsed(assignment, number)
        if steps in named and isinstance(value, dict):
            steps, value = (*steps, named[steps]), value.get(named[steps], said[steps][1])
        if steps in said and value != said[steps][1]:
            raise InputError(f"{said[steps][0]} and {written} contradict each other: give one")
