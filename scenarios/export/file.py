"""A file that can be written, and one that takes another's place once it is whole."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from cowalk.sim.basics.errors import InputError

from .folder import reason


def writable_file(file: str | Path, suffix: str) -> Path:
    """Return a file that can be written, its folder created; one that is there stays as it is.

    Parameters
    ----------
    file : str or Path
    suffix : str
        How its name must end, with the dot.

    Raises
    ------
    InputError
        If it cannot be written, or its name ends otherwise.
    """
    path = Path(file)
    if path.suffix.lower() != suffix:
        raise InputError(f"{file}: the name must end in {suffix}, as in run{suffix}")
    what = "give a file in a folder that can be written"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if os.path.lexists(path) and not path.is_file():
            raise InputError(f"{file}: cannot write there (it is no plain file); {what}")
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except (OSError, UnicodeError) as error:
        raise InputError(f"{file}: cannot write there ({reason(error)}); {what}") from error
    return path


def unfinished(file: Path) -> Path:
    """Return what a file is called while it is written: ``run.unfinished.mp4``."""
    return file.with_name(f"{file.stem}.unfinished{file.suffix}")


@contextmanager
def replacing(file: Path) -> Iterator[Path]:
    """Yield where to write a file that takes its place if nothing fails, and else leaves nothing.

    Parameters
    ----------
    file : Path
    """
    written = unfinished(file)
    try:
        yield written
        written.replace(file)
    except BaseException:
        with suppress(OSError):
            written.unlink(missing_ok=True)
        raise
