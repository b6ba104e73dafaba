"""The command ``cowalk``: run scenarios, list and check what there is, reproduce and compare.

Nothing but typer is imported before a command needs it, so that ``--help`` answers at once.
"""

from __future__ import annotations

import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..running.signals import Hold
from . import checking, humans, listing, mutants, new, recover, studies
from .changes import Changes, changing, option, read_changed
from .ending import complain_of_fault, exit_code, write_report
from .output import (
    BAD_INPUT,
    FAILED,
    FAULT,
    PASSED,
    Json,
    by_dimension,
    complain,
    emit_json,
    emit_table,
    json_alone,
    progress_bar,
    settle_streams,
    two_digits,
)

if TYPE_CHECKING:
    from ..files.loading import Reading
    from ..result import RunResult


def command_line() -> typer.Typer:
    """Return the command line, with an option for every part of the table."""
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
            "Exit codes: 0 all well, 1 an expectation failed, 2 bad input or a run that was\n"
            "aborted, 3 a fault of cowalk's own, 128 and its number after a signal."
        ),
    )
    app.command(
        epilog=(
            "\b\nExamples:\n"
            "  cowalk run puddle\n"
            "  cowalk run puddle --automation never-yields --out runs/stubborn\n"
            "  cowalk run puddle --set human.parameters.gain=2.0 --set world.obstacles.0.x=8\n"
            "  cowalk run puddle --sensor industrial --seed 3 --show\n"
            "  cowalk run puddle --video puddle.mp4 --rerun puddle.rrd\n"
            "  cowalk run my.scenario.yaml --human mymodels:MyHuman --json"
        )
    )(changing(run))
    checking.register(app)
    listing.register(app)
    humans.register(app)
    studies.register(app)
    mutants.register(app)
    new.register(app)
    recover.register(app)
    return app


def run(
    scenario: Annotated[
        str, typer.Argument(metavar="SCENARIO", help="Name in the library, or a YAML file.")
    ],
    changes: Changes,
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
    show: Annotated[
        bool,
        typer.Option(
            "--show", help="Print the final scenario, its values marked by origin; run nothing."
        ),
    ] = False,
    no_figure: Annotated[
        bool, typer.Option("--no-figure", help="Draw no picture: a run is then over sooner.")
    ] = False,
    samples: Annotated[
        bool, typer.Option("--samples", help="Keep every force sample too, in samples.parquet.")
    ] = False,
    step_timeout: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS",
            help="End the run if a control step takes longer: a part may never return.",
        ),
    ] = None,
    as_json: Json = False,
) -> int:
    """Run a scenario, keep what it gave, judge it."""
    reading = read_changed(scenario, changes)
    if show:
        return _show(reading, as_json)
    from ..export.run_folder import RunFolder
    from ..watch.writers import watchers

    loaded = reading.scenario
    with option("--video"):
        watching = watchers(video=video)
    with option("--rerun"):
        watching += watchers(recording=rerun)
    with option("--out"):
        place = RunFolder(out if out is not None else Path("runs") / loaded.name)
    with place:
        if place.left is not None:
            complain(f"a run that was killed has left {place.left}: cowalk recover {place.left}")
        # What a user's class prints must not end up among the results.
        label = f"filming {loaded.name}" if video is not None else loaded.name
        with progress_bar(label) as progress, redirect_stdout(sys.stderr):
            from ..running.runner import run as run_scenario

            result = run_scenario(loaded, progress, [place, *watching], gui, samples, step_timeout)
        with Hold() as hold:  # what ends the process now would end what is to be kept
            hold.begin()
            place.keep(result)
        for said in result.lost:
            complain(f"warning: {said}; all else is kept")
        written = {"video": video, "rerun": rerun}
        files = {what: str(file) for what, file in written.items() if file and file.exists()}
        if as_json:
            emit_json(
                result.summary | {"folder": str(place.folder), "passed": result.passed} | files
            )
        elif result.error is None:
            _report(result, files)
        if result.error is not None:
            _say_aborted(result, place.folder)
        if not no_figure:
            sys.stdout.flush()  # results first: drawing takes longer than most runs
            _draw(result, place.folder, silent=as_json or result.error is not None)
    if result.fault is not None:
        return FAULT
    if result.error is not None:
        return BAD_INPUT
    return PASSED if result.passed else FAILED


def _say_aborted(result: RunResult, folder: Path) -> None:
    """Say in one line why a run was ended, and where the trace is."""
    from ..export.run_folder import FAULT as REPORT

    kept = f"the trace so far, {len(result.trace)} rows, is in {folder / 'trace.parquet'}"
    if result.fault is not None:
        report = write_report(result.fault, folder / REPORT)
        complain_of_fault(str(result.error), report, kept)
    else:
        complain(f"{result.error}; {kept}")


def _draw(result: RunResult, folder: Path, silent: bool) -> None:
    """Draw the picture of a run, if that is possible."""
    from ..export.run_folder import draw_figure, no_figure

    try:
        picture = draw_figure(result, folder)
    except Exception as error:
        complain(f"warning: {no_figure(error)}")
    else:
        if not silent:
            _say_file("picture", str(picture))


def _show(reading: Reading, as_json: bool) -> int:
    from ..files.assembling import resolve
    from ..files.loading import plain
    from ..files.origins import marked, origins

    if as_json:
        scenario = plain(resolve(reading.scenario))
        emit_json({"scenario": scenario, "origins": origins(reading)})
    else:
        print(marked(reading), end="")
    return PASSED


def _say_file(what: str, file: str) -> None:
    print(f"{what + ':':<9} {file}")


def _report(result: RunResult, files: dict[str, str]) -> None:
    from ..expect.verdict import explain
    from ..files.assembling import said_parts
    from ..result import how_it_ended
    from ..trace.sensor_faults import sensor_faults

    summary = result.summary
    metrics = summary["metrics"]
    if metrics:
        emit_table(
            f"{result.scenario.name}, seed {summary['seed']}",
            ("metric", "value", "v, forward", "omega, sideways", "unit"),
            by_dimension(metrics),
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
    if not all(verdict.passed for verdict in result.verdicts):
        print(f"run:      {said_parts(result.scenario)}")
    print(f"ended by: {how_it_ended(summary)}")
    if faults := sensor_faults(summary):
        print(f"sensor:   {faults}")
    factor, wall = summary["real_time_factor"], summary["wall_time_s"]
    if factor is not None:
        print(f"speed:    {two_digits(factor)} times real time ({wall:.2f} s)")
    for what, file in files.items():
        _say_file(what, file)


def main() -> None:
    """Run the command line and exit with its code."""
    settle_streams()
    # Without arguments: the help, not a complaint.
    arguments = sys.argv[1:] or ["--help"]
    with json_alone("--json" in arguments):
        code = exit_code(
            lambda: command_line()(args=arguments, prog_name="cowalk", standalone_mode=False)
        )
    sys.exit(code)
