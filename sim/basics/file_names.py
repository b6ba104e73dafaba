"""Files that a user names: parameters marked as such, and reading without a trap."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import Annotated, Any, get_args

from .errors import InputError

_MARK = object()

FileName = Annotated[str, _MARK]
"""Text that names a file. In a scenario file, a relative one begins where that file lies."""


def names_file(hint: Any) -> bool:
    """Return whether a parameter with an annotation names a file: a `FileName`, or a path.

    Parameters
    ----------
    hint : annotation
        With what `typing.Annotated` adds.
    """
    if hint is os.PathLike or (isinstance(hint, type) and issubclass(hint, Path)):
        return True
    arms = get_args(hint)
    return any(arm is _MARK or names_file(arm) for arm in arms)


def read_file(file: Path, most: int) -> bytes:
    """Return what a file holds; nothing but a plain file is read, so that nothing waits.

    Parameters
    ----------
    file : Path
    most : int
        Bytes that it may hold.

    Raises
    ------
    InputError
        If it is a folder, a pipe or a device, is too large, or cannot be read.
    """
    # A pipe would be waited for, and a device may act when it is opened.
    if (what := what_it_is(file)) is not None:
        raise InputError(f"{file}: this {what}; a file is needed")
    try:
        handle = os.open(file, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
        with os.fdopen(handle, "rb") as opened:
            data = opened.read(most + 1)
    except OSError as error:
        raise InputError(f"{file}: cannot be read ({error.strerror})") from error
    except ValueError as error:  # a null byte in its name
        raise InputError(f"{str(file)!r}: cannot be read ({error})") from error
    if len(data or b"") > most:
        raise InputError(f"{file}: it holds more than {most:,} bytes")
    return data or b""


def what_it_is(file: Path) -> str | None:
    """Return what there is in the place of a plain file, None if it is one or nothing is there."""
    try:
        mode = file.stat().st_mode
    except (OSError, ValueError):
        return None
    if stat.S_ISREG(mode):
        return None
    kinds = {stat.S_ISDIR: "is a folder", stat.S_ISFIFO: "is a pipe", stat.S_ISSOCK: "is a socket"}
    return next((said for kind, said in kinds.items() if kind(mode)), "is a device")
