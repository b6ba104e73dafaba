"""The command that finds faults, in scenario files and in parts of one's own."""

from __future__ import annotations

import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import Annotated

import typer

from .changes import Trust
from .output import BAD_INPUT, FAILED, PASSED, complain, progress_bar


def register(app: typer.Typer) -> None:
    """Add this command to the command line."""
    app.command(
        epilog=(
            "\b\nExamples:\n"
            "  cowalk check my.scenario.yaml\n"
            "  cowalk check *.scenario.yaml\n"
            "  cowalk check --strict my.scenario.yaml\n"
            "  cowalk check mymodels:MyHuman\n\n\b\n"
            "With --strict, exit code 1 says that an expectation fails, or holds vacuously: it\n"
            "would hold even if what it asks for never did."
        )
    )(check)


def check(
    files: Annotated[
        list[str],
        typer.Argument(
            metavar="FILE...", help="Scenario files, or parts of your own as module:Class."
        ),
    ],
    strict: Annotated[
        bool,
        typer.Option(
            "--strict",
            help="Run each scenario as well: every expectation must hold, and not vacuously.",
        ),
    ] = False,
    trust: Trust = False,
) -> int:
    """Report every fault of scenario files, or of parts of your own."""
    from cowalk.sim.basics.errors import InputError

    from ..files.loading import faults, find
    from ..files.own_parts import judge_own_part

    code = PASSED
    for file in files:
        part = ":" in file and not Path(file).exists()
        kind = ""
        if file.endswith(".py"):
            complain(f"{file} is Python: give what to check in it, {Path(file).stem}:MyClass")
            code = BAD_INPUT
            continue
        try:
            if part:
                kind, found = judge_own_part(file)
            else:
                found = list(map(str, faults(find(file), trust=trust))) or _tried(find(file), trust)
        except InputError as error:
            if part:  # there is nothing to check
                complain(str(error))
                code = BAD_INPUT
                continue
            found = [str(error)]
        one = BAD_INPUT if found else PASSED
        if strict and not part and not found:
            found, one = _not_met(find(file), trust)
        print("\n".join(found) if found else f"{file}: no fault{f' ({kind})' * bool(kind)}")
        code = max(code, one)
    return code


def _tried(file: Path, trust: bool) -> list[str]:
    """Return what keeps a scenario without faults from taking a step, a line each."""
    from ..files.loading import load, read_document
    from ..running.trial import trial

    document = read_document(file)
    with redirect_stdout(sys.stderr):
        found = trial(load(file, trust=trust))
    return [f"{file}:{document.line(fault.path)}: {fault.message}" for fault in found]


def _not_met(file: Path, trust: bool) -> tuple[list[str], int]:
    """Run a scenario; return what it does not meet, a line each, and the exit code for it."""
    from ..expect.verdict import explain
    from ..files.assembling import said_parts
    from ..files.loading import load, read_document
    from ..running.runner import run

    scenario = load(file, trust=trust)
    with progress_bar(scenario.name) as progress, redirect_stdout(sys.stderr):
        result = run(scenario, progress)
    if result.error is not None:
        return [f"{file}: the run was aborted: {result.error}"], BAD_INPUT
    document = read_document(file)
    found = []
    for verdict in result.verdicts:
        if verdict.passed and verdict.vacuous is None:
            continue
        line = document.line(("expect", verdict.name))
        what = "holds" if verdict.passed else "fails"
        found.append(
            f"{file}:{line}: expect.{verdict.name} = {verdict.formula!r} {what}: "
            f"{explain(verdict)} ({said_parts(scenario)})"
        )
    return found, FAILED if found else PASSED
