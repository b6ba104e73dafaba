"""A folder that can be written."""

from __future__ import annotations

import os
import tempfile
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
        with tempfile.TemporaryFile(dir=path):  # no file of the user's has its name
            pass
    except (OSError, UnicodeError) as error:
        raise cannot_write(folder, error) from error
    return path


def cannot_write(folder: str | Path, error: OSError | UnicodeError) -> InputError:
    """Return why nothing can be written to a folder, as an error."""
    return InputError(f"{folder}: cannot write there ({reason(error)}); give a writable folder")


def reason(error: OSError | UnicodeError) -> str:
    """Return why the system refuses a file, in its own words."""
    if isinstance(error, UnicodeError):
        return "this locale has no such letters in file names; LC_ALL=C.UTF-8 has"
    return os.strerror(error.errno) if error.errno else str(error)
