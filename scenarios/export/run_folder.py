"""What a run leaves on disk: its folder, and its picture as bytes for whoever shows it."""

from __future__ import annotations

import io
import json
from pathlib import Path

from ..files.assembling import resolve
from ..files.loading import to_yaml
from ..result import RunResult
from .folder import writable_folder

FIGURE = "figure.png"


def write_run(result: RunResult, folder: str | Path, figure: bool = True) -> Path:
    """Write trace.parquet, summary.json, scenario.yaml and figure.png into a folder.

    With samples.parquet, if the run kept single force samples.

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

    Raises
    ------
    InputError
        If the folder cannot be written.
    """
    folder = writable_folder(folder)
    result.trace.write(folder / "trace.parquet")
    samples = folder / "samples.parquet"
    samples.unlink(missing_ok=True)
    if result.samples is not None:
        result.samples.write(samples)
    (folder / "summary.json").write_text(json.dumps(result.summary, indent=2) + "\n")
    (folder / "scenario.yaml").write_text(to_yaml(resolve(result.scenario)))
    (folder / FIGURE).unlink(missing_ok=True)
    if figure:
        draw_figure(result, folder)
    return folder


def draw_figure(result: RunResult, folder: Path) -> Path:
    """Draw the picture of a run into its folder and return the file."""
    # Brings matplotlib, which takes longer to import than a run to start.
    from ..figures.run import draw_run

    file = folder / FIGURE
    draw_run(result, file)
    return file


def picture(result: RunResult) -> bytes:
    """Return the picture of a run as PNG, as notebooks show it."""
    from ..figures.run import draw_run

    stream = io.BytesIO()
    draw_run(result, stream)
    return stream.getvalue()
