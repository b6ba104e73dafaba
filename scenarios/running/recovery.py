"""A run whose process was killed: what it has left becomes a run folder."""

from __future__ import annotations

import math
import shutil
from contextlib import suppress
from pathlib import Path
from typing import Any

from cowalk.sim.basics.errors import InputError

from ..export.run_folder import SCENARIO, STREAM, RunFolder
from ..files.schema import Scenario, scenario_model
from ..files.validation import validate
from ..result import RunResult
from ..trace.stream import read_stream
from ..yaml_text.document import parse
from .measured import measured
from .outcome import Attempt, outcome


def recover_run(folder: str | Path) -> RunResult | None:
    """Make a run folder of what a run has left that was killed; none of its parts is built.

    The trace goes to the last batch that was written whole, at most some 10 s before the end.
    Metrics and verdicts are of that; what is counted while a run goes on is not there.

    Parameters
    ----------
    folder : str or Path
        That the run was to write, or in which it has left ``trace.arrow``.

    Returns
    -------
    RunResult or None
        Its summary says ``end: recovered``. None if the run was complete, and killed only while
        its files were moved into place, which was then done.

    Raises
    ------
    InputError
        If nothing is left there, it cannot be read, or the folder cannot be written.
    """
    target = Path(folder)
    if not target.is_dir():
        raise InputError(f"{folder}: there is no such folder; give that of a run that was killed")
    direct = (target / STREAM).is_file()
    with RunFolder(target) as place:
        if place.finished:
            return None
        left = target if direct else place.left
        if left is None:
            raise InputError(f"{folder}: no run that was killed has left anything there")
        trace, scenario = read_stream(left / STREAM), _written_scenario(left / SCENARIO)
        if not len(trace):
            raise InputError(f"{left / STREAM}: holds no row: the run had just begun")
        period = scenario.rates.period
        error = (
            f"{scenario.name}: the process was killed; recovered to t = {len(trace) * period:g} s"
        )
        attempt = Attempt()
        unmeasured: dict[str, Any] = {}
        found = attempt(lambda: measured(scenario, trace), unmeasured)
        result = outcome(scenario, trace, "recovered", error, math.nan, found, attempt)
        result.fault = attempt.fault
        place.keep(result)
    with suppress(OSError):
        (left / STREAM).unlink()
    if left != target:
        shutil.rmtree(left, ignore_errors=True)
    return result


def _written_scenario(file: Path) -> Scenario:
    """Return the scenario that a run folder holds, without building or importing any part of it.

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
