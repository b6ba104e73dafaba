"""How a command ends: its exit code, and one line on standard error that says why."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from .output import BAD_INPUT, FAULT, PASSED, SIGNALLED, complain

FILING = "please file it with that report (docs/exit-codes.md)"
_CLOSED = "standard output was closed: not all was printed"


def exit_code(command: Callable[[], int | None]) -> int:
    """Run a command to its end; return its exit code, whatever has ended it."""
    from ..running.signals import SIGNALS

    try:
        with SIGNALS.heard():
            code = _exit_code(command)
    except KeyboardInterrupt:  # as it began or ended
        code = BAD_INPUT
    return code if SIGNALS.received is None else SIGNALLED + SIGNALS.received


def _exit_code(command: Callable[[], int | None]) -> int:
    try:
        code = command()
        sys.stdout.flush()
        return PASSED if code is None else code
    except KeyboardInterrupt:
        return BAD_INPUT
    except SystemExit as end:
        if isinstance(end.__context__, BrokenPipeError):
            return _unprinted(_CLOSED)
        return _fault(end)
    except BrokenPipeError:
        return _unprinted(_CLOSED)
    except BaseException as error:
        message = _one_line(error)
        if message is None:
            return _fault(error)
        if isinstance(error, OSError) and error.filename is None:
            return _unprinted(message)
        complain(message)
        return BAD_INPUT


def _unprinted(message: str) -> int:
    """Complain that standard output takes nothing more, and let nobody try again."""
    with suppress(OSError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.close(nowhere)
    complain(message)
    return BAD_INPUT


def _one_line(error: BaseException) -> str | None:
    """Return what a user did wrong, or None if the error is ours."""
    # Typer brings its own copy of click or uses the installed one: no class to name for both.
    if hasattr(error, "format_message"):
        said = error.format_message().replace("Value error, ", "").rstrip(".")
        where = getattr(getattr(error, "ctx", None), "command_path", "cowalk")
        return f"{said} (see {where} --help)"
    from cowalk.sim.basics.errors import InputError, SimulationError, told

    if isinstance(error, OSError):
        what = error.strerror or told(error)
        return f"{error.filename}: {what}" if error.filename is not None else f"output: {what}"
    return str(error) if isinstance(error, InputError | SimulationError) else None


def _fault(error: BaseException) -> int:
    """Report a fault of cowalk's own; return the exit code for it."""
    from traceback import format_exception

    from cowalk.sim.basics.errors import told

    try:
        traceback = "".join(format_exception(error))
    except BaseException:  # its text may raise anything
        traceback = f"{told(error)}, of which no traceback can be made\n"
    complain_of_fault(told(error), write_report(traceback))
    return FAULT


def complain_of_fault(what: str, report: Path | None, trace: str = "") -> None:
    """Say in one line what went wrong, where trace and report lie, and what to do."""
    lies = f"report: {report}" if report is not None else "no report could be written"
    complain(f"a fault of cowalk's own: {what}; {trace and f'{trace}; '}{lies}; {FILING}")


def write_report(traceback: str, file: Path | None = None) -> Path | None:
    """Write the report of a fault and return where it is; None if that is not possible.

    Parameters
    ----------
    traceback : str
    file : Path, optional
        In the folder for temporary files unless given.
    """
    text = report(traceback)
    try:
        if file is not None:
            file.write_text(text, encoding="utf-8", errors="backslashreplace")
            return file
        descriptor, name = tempfile.mkstemp(prefix="cowalk-fault-", suffix=".txt")
        with open(descriptor, "w", encoding="utf-8", errors="backslashreplace") as out:
            out.write(text)
    except OSError:
        return None
    return Path(name)


def report(traceback: str) -> str:
    """Return what helps to find a fault: what was called, the versions, the traceback."""
    import platform
    import shlex

    from ..running.outcome import versions

    said = {"python": platform.python_version(), **versions()}
    return "\n".join(
        (
            f"command:  {shlex.join(['cowalk', *sys.argv[1:]])}",
            f"system:   {platform.platform()}",
            f"versions: {', '.join(f'{name} {number}' for name, number in said.items())}",
            "",
            traceback,
        )
    )
