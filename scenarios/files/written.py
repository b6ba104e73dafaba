"""A scenario as a run has written it: read without building, or importing, any part of it."""

from __future__ import annotations

from pathlib import Path

from cowalk.sim.basics.errors import InputError

from .documents import parse
from .schema import Scenario, scenario_model
from .validation import validate


def read_written(file: Path) -> Scenario:
    """Return the scenario that a run folder holds; what its parts are is not looked at.

    Raises
    ------
    InputError
        If it cannot be read, or is none.
    """
    try:
        if not file.is_file():
            raise InputError(f"{file}: there is no such file")
        document = parse(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{file}: cannot be read ({error})") from error
    scenario, problems = validate(scenario_model(), document.data)
    if scenario is None or document.problems:
        first = (document.problems or problems)[0]
        raise InputError(f"{file}:{document.line(first.path)}: {first.message}")
    return scenario
