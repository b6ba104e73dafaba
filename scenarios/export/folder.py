"""A folder that can be written."""

from __future__ import annotations

from pathlib import Path

from cowalk.sim.basics.errors import InputError


def writable_folder(folder: str | Path) -> Path:
    """Create a folder and return it.

    Raises
    ------
    InputError
        If it cannot be created or written to.
    """
    path = Path(folder)
    try:
        path.mkdir(parents=True, exist_ok=True)
        probe = path / ".write-test"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise InputError(
            f"{folder}: cannot write there ({error.strerror}); give a writable folder"
        ) from error
    return path
