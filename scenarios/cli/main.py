"""The command ``cowalk``: run scenarios, list and check what there is, reproduce and compare.

Nothing but typer is imported before a command needs it, so that ``--help`` answers at once.
"""

from __future__ import annotations

import signal
import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import humans as cli_humans
from . import listing as cli_list
from . import studies as cli_studies
from .output import (
    BAD_INPUT,
    FAILED,
    PASSED,
    Json,
    complain,
    emit_json,
    emit_table,
    progress_bar,
    two_digits,
)

if TYPE_CHECKING:
    from ..files.schema import Scenario
    from ..trace.result import RunResult

app = typer.Typer(
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="A human and a robot negotiate where to walk: simulate it, measure it, judge it.",
    epilog=(
        "\b\nExamples:\n"
        "  cowalk run puddle\n"
        "  cowalk list\n"
        "  cowalk COMMAND --help\n\n\b\n"
        "Exit codes: 0 all well, 1 an expectation failed, 2 bad input or a run that was aborted."
    ),
)


@app.command(
    epilog=(
        "\b\nExamples:\n"
        "  cowalk run puddle\n"
        "  cowalk run puddle --automation never-yields --out runs/stubborn\n"
        "  cowalk run puddle --set human.parameters.gain=2.0 --set world.obstacles.0.x=8 --seed 3\n"
        "  cowalk run puddle --video puddle.mp4 --rerun puddle.rrd\n"
        "  cowalk run my.scenario.yaml --human mymodels:MyHuman --json"
    )
)
def run(
    scenario: Annotated[
        str, typer.Argument(metavar="SCENARIO", help="Name in the library, or a YAML file.")
    ],
    plant: Annotated[str, typer.Option(help="Plant instead of the scenario's.")] = "",
    human: Annotated[str, typer.Option(help="Human model instead: name or module:Class.")] = "",
    automation: Annotated[str, typer.Option(help="Automation instead: name or module:Class.")] = "",
    smoother: Annotated[str, typer.Option(help="The automation's smoother instead.")] = "",
    assign: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Replace one value; may be repeated."),
    ] = None,
    seed: Annotated[int | None, typer.Option(help="Seed instead of the scenario's.")] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Run folder, runs/NAME unless given.")
    ] = None,
    video: Annotated[
        Path | None, typer.Option(metavar="FILE.mp4", help="Film the run as well.")
    ] = None,
    rerun: Annotated[
        Path | None,
        typer.Option(metavar="FILE.rrd", help="Record it for the Rerun viewer as well."),
    ] = None,
    gui: Annotated[bool, typer.Option("--gui", help="Show the run in a window.")] = False,
    as_json: Json = False,
) -> int:
    """Run a scenario, keep what it gave, judge it."""
    from ..export.folder import writable_folder
    from ..running.runner import run as run_scenario
    from ..watch.watcher import watchers

    options = {
        "plant": plant,
        "human": human,
        "automation": automation,
        "smoother": smoother,
        "seed": "" if seed is None else str(seed),
    }
    loaded = _load(scenario, options, assign or [])
    watching = watchers(video, rerun)
    folder = writable_folder(out if out is not None else Path("runs") / loaded.name)
    # What a user's class prints must not end up in the JSON.
    label = f"filming {loaded.name}" if video is not None else loaded.name
    with progress_bar(label) as progress, redirect_stdout(sys.stderr):
        result = run_scenario(loaded, progress, watching, gui)
    result.write(folder)
    written = {"video": video, "rerun": rerun}
    files = {what: str(file) for what, file in written.items() if file is not None}
    if as_json:
        emit_json(result.summary | {"folder": str(folder), "passed": result.passed} | files)
    elif result.error is None:
        _report(result, folder, files)
    if result.error is not None:
        kept = f"the trace so far, {len(result.trace)} rows, is in {folder / 'trace.parquet'}"
        complain(f"{result.error}; {kept}")
        return BAD_INPUT
    return PASSED if result.passed else FAILED


def _load(source: str, options: dict[str, str], assignments: list[str]) -> Scenario:
    """Return the scenario with its parts swapped and values set; blame the option given."""
    from cowalk.sim.basics.errors import InputError

    from ..files.loading import load

    keys = {"smoother": "automation.smoother"}
    swaps = {name: f"{keys.get(name, name)}={value}" for name, value in options.items() if value}
    try:
        return load(source, [*swaps.values(), *assignments])
    except InputError as error:
        message = str(error)
        for name, assignment in swaps.items():
            if assignment not in assignments:
                message = message.replace(f"--set {assignment}:", f"--{name} {options[name]}:")
        raise InputError(message) from error


def _report(result: RunResult, folder: Path, files: dict[str, str]) -> None:
    from ..expect.verdict import explain
    from ..trace.result import how_it_ended
    from ..trace.sensor_faults import sensor_faults

    summary = result.summary
    metrics = summary["metrics"]
    if metrics:
        rows = [(name, entry["value"], entry["unit"]) for name, entry in metrics.items()]
        emit_table(
            f"{result.scenario.name}, seed {summary['seed']}", ("metric", "value", "unit"), rows
        )
    if result.verdicts:
        emit_table(
            "expectations",
            ("expectation", "verdict", "by how much"),
            [
                (verdict.name, "holds" if verdict.passed else "FAILS", explain(verdict))
                for verdict in result.verdicts
            ],
        )
    picture = folder / "figure.png"
    if picture.exists():
        files = {"picture": str(picture)} | files
    for what, file in files.items():
        print(f"{what + ':':<9} {file}")
    print(f"ended by: {how_it_ended(summary)}")
    if faults := sensor_faults(summary):
        print(f"sensor:   {faults}")
    factor, wall = summary["real_time_factor"], summary["wall_time_s"]
    if factor is not None:
        print(f"speed:    {two_digits(factor)} times real time ({wall:.2f} s)")


@app.command(
    epilog=(
        "\b\nExamples:\n"
        "  cowalk check my.scenario.yaml\n"
        "  cowalk check *.scenario.yaml\n"
        "  cowalk check mymodels:MyHuman"
    )
)
def check(
    files: Annotated[
        list[str],
        typer.Argument(metavar="FILE...", help="Scenario files, or agents as module:Class."),
    ],
) -> int:
    """Report every fault of scenario files with its line, or of your own agents."""
    from cowalk.sim.basics.errors import InputError

    from ..files.loading import faults, find

    code = PASSED
    for file in files:
        agent = ":" in file and not Path(file).exists()
        try:
            if agent:
                found = cli_humans.agent_faults(file)
            else:
                found = [str(fault) for fault in faults(find(file))]
        except InputError as error:
            if agent:  # there is nothing to check
                complain(str(error))
                code = BAD_INPUT
                continue
            found = [str(error)]
        print("\n".join(found) if found else f"{file}: no fault")
        code = BAD_INPUT if found else code
    return code


cli_list.register(app)
cli_humans.register(app, lambda as_json: cli_list.list_parts(cli_list.Kind.HUMANS, as_json))
cli_studies.register(app)


def main() -> None:
    """Run the command line and exit with its code."""
    # A run that is told to stop keeps what it has, as after Ctrl-C.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    # Without arguments: the help, not a complaint.
    try:
        code = app(args=sys.argv[1:] or ["--help"], prog_name="cowalk", standalone_mode=False)
    except Exception as error:
        message = _one_line(error)
        if message is None:
            raise
        complain(message)
        code = BAD_INPUT
    sys.exit(code)


def _one_line(error: Exception) -> str | None:
    """Return what a user did wrong, or None if the error is ours."""
    # Typer brings its own copy of click or uses the installed one: no class to name for both.
    if hasattr(error, "format_message"):
        said = error.format_message().replace("Value error, ", "").rstrip(".")
        return f"{said} (see cowalk --help)"
    from cowalk.sim.basics.errors import InputError, SimulationError

    return str(error) if isinstance(error, InputError | SimulationError) else None
