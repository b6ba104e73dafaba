"""The command that writes a start of one's own part, or scenario, to change."""

from __future__ import annotations

import importlib.util
import keyword
import re
from pathlib import Path
from string import Template
from typing import Annotated

import typer

from ..files.parts import Part, parts
from .output import PASSED

SCENARIO = "scenario"
_TEMPLATES = Path(__file__).parents[1] / "templates"


def register(app: typer.Typer) -> None:
    """Add this command to the command line."""
    command = app.command(
        name="new",
        help=f"Write a start of a part or scenario of your own. KIND is {', '.join(startable())}.",
        epilog=(
            "\b\nExamples:\n"
            "  cowalk new human hasty_human\n"
            "  cowalk new observer my_observer\n"
            "  cowalk new scenario my-corridor"
        ),
    )
    command(new)


def startable() -> list[str]:
    """Return the kinds of which there is a start."""
    return [*(_word(part) for part in parts() if _template(_word(part)).exists()), SCENARIO]


def _word(part: Part) -> str:
    return part.kind.replace(" ", "-")


def _template(word: str) -> Path:
    return _TEMPLATES / f"{word}{'.yaml' if word == SCENARIO else '.py'}.template"


def new(
    kind: Annotated[str, typer.Argument(metavar="KIND", help="What to write.")],
    name: Annotated[str, typer.Argument(metavar="NAME", help="Of the file, without its ending.")],
) -> int:
    """Write a start of one's own, and say how to check, run and compare it."""
    from cowalk.sim.basics.errors import InputError
    from cowalk.sim.basics.registry import did_you_mean

    if kind not in startable():
        raise InputError(f"unknown kind {kind!r}; {did_you_mean(kind, startable())}")
    if kind == SCENARIO:
        file, what = Path(f"{_plain(name)}.scenario.yaml"), SCENARIO
        commands = [
            f"cowalk check {file}",
            f"cowalk run {file}",
            f"cowalk compare automations {file}",
        ]
    else:
        part = next(part for part in parts() if _word(part) == kind)
        file, written = Path(f"{_importable(name)}.py"), f"{name}:{camel_case(name)}"
        what = f"{kind} {camel_case(name)}"
        commands = [
            f"cowalk check {written}",
            f"cowalk run puddle --{part.flag} {written}",
            f"cowalk compare {part.plural} --with {written}",
        ]
    text = Template(_template(kind).read_text(encoding="utf-8"))
    try:
        with file.open("x", encoding="utf-8") as out:
            out.write(text.substitute(name=name, Name=camel_case(name)))
    except FileExistsError:
        raise InputError(f"{file} is there already: give another name") from None
    except OSError as error:
        raise InputError(f"{file}: cannot be written ({error.strerror})") from error
    print(f"wrote {file}, {what}; next:")
    print("\n".join(f"  {command}" for command in commands))
    return PASSED


def camel_case(name: str) -> str:
    """Return the name of the class in a module: ``HastyHuman`` for ``hasty_human``."""
    return "".join(word[:1].upper() + word[1:] for word in name.split("_"))


def _plain(name: str) -> str:
    """Return a name that can be that of a scenario, and refuse any other."""
    from cowalk.sim.basics.errors import InputError

    if not re.fullmatch(r"\w[\w-]*", name):
        raise InputError(f"{name!r} is no name of a scenario: letters, digits, _ and - make one")
    return name


def _importable(name: str) -> str:
    """Return a name that can be that of a user's own module, and refuse any other."""
    from cowalk.sim.basics.errors import InputError

    if not name.isidentifier() or keyword.iskeyword(name) or not camel_case(name).isidentifier():
        near = re.sub(r"\W+", "_", name).strip("_").lower()
        usable = near.isidentifier() and not keyword.iskeyword(near)
        advice = near if usable else "hasty_human"
        raise InputError(f"{name!r} is no name of a Python module; {advice!r} would be")
    # What is installed is found before what lies in the working folder.
    if not Path(f"{name}.py").exists() and importlib.util.find_spec(name) is not None:
        raise InputError(f"{name!r} is a module that is installed: give another name")
    return name
