"""What a run leaves on disk: its folder, and its picture as bytes for whoever shows it."""

from __future__ import annotations

import io
import json
import warnings
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from cowalk.sim.basics.errors import InputError, told

from ..files.assembling import resolve
from ..files.loading import to_yaml
from ..result import RunResult
from ..trace.stream import TraceStream
from .claim import Claim
from .file import replacing
from .folder import reason

if TYPE_CHECKING:
    from cowalk.sim.env.env import CowalkEnv

    from ..files.schema import Scenario
    from ..trace.trace import Trace

STREAM = "trace.arrow"
TRACE, SAMPLES, SUMMARY, SCENARIO = (
    "trace.parquet",
    "samples.parquet",
    "summary.json",
    "scenario.yaml",
)
FIGURE, FAULT = "figure.png", "fault.txt"
PIECES = (TRACE, SAMPLES, SUMMARY, SCENARIO, FIGURE, FAULT)
"""Every file that a run folder may have."""


class RunFolder:
    """The folder of a run, from before it begins: a watcher that keeps the trace meanwhile.

    Until `keep` has moved everything into place, what there is lies in ``unfinished`` within the
    folder, and what an earlier run left stays as it is. `recover` makes a run folder of it.

    Parameters
    ----------
    folder : str or Path
        Created if need be.

    Raises
    ------
    InputError
        If it cannot be written, or another run writes there.
    """

    def __init__(self, folder: str | Path) -> None:
        self._claim = Claim(folder, PIECES, STREAM)
        self._stream = TraceStream(self._claim.place / STREAM)
        self._trace: Trace | None = None
        self._kept = False

    @property
    def folder(self) -> Path:
        """The folder itself."""
        return self._claim.folder

    @property
    def left(self) -> Path | None:
        """Where what an earlier run left that was killed is now, if there was one."""
        return self._claim.kept

    @property
    def finished(self) -> bool:
        """Whether an earlier run was killed while its files came into place: they have now."""
        return self._claim.finished

    def __enter__(self) -> RunFolder:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Leave the folder; without rows to keep, as if nobody had been there."""
        if not self._kept and not self._stream.rows:
            self._claim.discard()
        self._claim.release()

    def start(self, scenario: Scenario, env: CowalkEnv) -> None:
        """Note what is run; see `cowalk.scenarios.watch.watcher.Watcher.start`.

        Raises
        ------
        InputError
            If the disk is full.
        """
        self._write(SCENARIO, lambda file: _text(file, to_yaml(resolve(scenario))))

    def step(self, env: CowalkEnv, trace: Trace) -> None:
        """Write new rows if it is time; see `cowalk.scenarios.watch.watcher.Watcher.step`."""
        self._trace = trace
        self._stream.follow(trace)

    def close(self) -> None:
        """Write the last rows; see `cowalk.scenarios.watch.watcher.Watcher.close`."""
        if self._trace is not None:
            self._stream.write(self._trace)

    def keep(self, result: RunResult) -> None:
        """Write what a run gave, and move it into place; the picture of an earlier run goes.

        Parameters
        ----------
        result : RunResult

        Raises
        ------
        InputError
            If it cannot be written. The folder is then as it was, and what was written so far
            lies in ``unfinished``.
        """
        self._write(TRACE, result.trace.write)
        if result.samples is not None:
            self._write(SAMPLES, result.samples.write)
        summary = json.dumps(result.summary, indent=2) + "\n"
        self._write(SUMMARY, lambda file: _text(file, summary))
        self._write(SCENARIO, lambda file: _text(file, to_yaml(resolve(result.scenario))))
        self._claim.commit()
        self._kept = True

    def _write(self, name: str, write: Callable[[Path], None]) -> None:
        file = self._claim.place / name
        try:
            write(file)
        except OSError as error:
            there = f"; the trace so far, {self._stream.rows} rows, is in {self._claim.place}: "
            cure = f"{there}cowalk recover {self.folder}" if self._stream.rows else ""
            raise InputError(
                f"{self.folder / name}: cannot be written ({reason(error)}){cure}"
            ) from error


def write_run(result: RunResult, folder: str | Path, figure: bool = True) -> Path:
    """Write trace.parquet, summary.json, scenario.yaml and figure.png into a folder.

    With samples.parquet, if the run kept single force samples. They come into place together,
    and replace those of an earlier run; other files stay.

    Parameters
    ----------
    result : RunResult
    folder : str or Path
        Created if need be.
    figure : bool
        Draw figure.png, which takes longer than most runs. Without, that of an earlier run in
        the same folder is removed.

    Returns
    -------
    Path
        The folder.

    Warns
    -----
    RuntimeWarning
        If the figure cannot be drawn.

    Raises
    ------
    InputError
        If the folder cannot be written, or another run writes there.
    """
    with RunFolder(folder) as place:
        place.keep(result)
        if figure:
            try:
                draw_figure(result, place.folder)
            except Exception as error:
                warnings.warn(no_figure(error), RuntimeWarning, stacklevel=2)
    return place.folder


def draw_figure(result: RunResult, folder: Path) -> Path:
    """Draw the picture of a run into its folder and return the file."""
    # Brings matplotlib, which takes longer to import than a run to start.
    from ..figures.run import draw_run

    with replacing(folder / FIGURE) as file:
        draw_run(result, file)
    return folder / FIGURE


def no_figure(error: Exception) -> str:
    """Return that there is no picture of a run, and why, in one line."""
    why = reason(error) if isinstance(error, OSError) else told(error)
    return f"no picture was drawn ({why}); all else is kept"


def picture(result: RunResult) -> bytes:
    """Return the picture of a run as PNG, as notebooks show it."""
    from ..figures.run import draw_run

    stream = io.BytesIO()
    draw_run(result, stream)
    return stream.getvalue()


def _text(file: Path, text: str) -> None:
    file.write_text(text, encoding="utf-8", errors="backslashreplace")
