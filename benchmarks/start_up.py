"""What a command takes as a process, beside a process that only imports NumPy."""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
from statistics import median

ROUNDS = 9
MAIN = "from cowalk.scenarios.cli.main import main; main()"
RUN = f"""
import sys, time
from cowalk.scenarios.running import runner

inner = runner.run

def run(*arguments):
    started = time.process_time()
    result = inner(*arguments)
    print(time.process_time() - started, file=sys.stderr)
    return result

runner.run = run
{MAIN}
"""
"""The command line; what the run itself takes is written on standard error, s."""
PLAIN = ("run", "puddle", "--no-figure")
AT_MOST = ("at most", 6.0)

NUMPY = "import numpy"
MEASURED: dict[str, tuple[str, tuple[str, ...], tuple[str, float] | None]] = {
    NUMPY: (NUMPY, (), None),
    "run puddle --no-figure, less the run": (RUN, PLAIN, AT_MOST),
    "the same without expectations": (RUN, (*PLAIN, "--set", "expect={}"), AT_MOST),
    "run puddle, less the run": (RUN, PLAIN[:2], None),
    "import loader and runner": (
        "import cowalk.scenarios.files.loading, cowalk.scenarios.running.runner",
        (),
        None,
    ),
    "--help": (MAIN, ("--help",), None),
    "list": (MAIN, ("list",), None),
}
"""Code, arguments and target by what is measured."""


def _time(code: str, arguments: tuple[str, ...], folder: str) -> float:
    """Return the processor time of a process, less that of the run in it, s.

    Processor time, because others on the machine make a long process wait more than a short one.
    """
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-c", code, *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    whole = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return whole - (float(done.stderr.splitlines()[-1]) if code == RUN else 0.0)


def measure() -> list[tuple[str, float, str, tuple[str, float] | None]]:
    """Return rows of (what, value, unit, target): medians of ratios within a round."""
    with tempfile.TemporaryDirectory() as folder:
        rounds = [
            {what: _time(code, given, folder) for what, (code, given, _) in MEASURED.items()}
            for _ in range(ROUNDS)
        ]
    base = min(times[NUMPY] for times in rounds)
    return [
        (f"{NUMPY}, as a process", base * 1e3, "ms", None),
        *(
            (what, median(times[what] / times[NUMPY] for times in rounds), f"x {NUMPY}", target)
            for what, (_, _, target) in MEASURED.items()
            if what != NUMPY
        ),
    ]
