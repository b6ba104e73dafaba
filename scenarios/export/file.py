"""A file that can be written."""

from __future__ import annotations

from pathlib import Path

from cowalk.sim.basics.errors import InputError


def writable_file(file: str | Path, suffix: str) -> Path:
    """Return a file that can be written, its folder created.

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
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        existed = path.exists()
        path.open("ab").close()
        if not existed:
            path.unlink()
    except OSError as error:
        raise InputError(
            f"{file}: cannot write there ({error.strerror}); give a file in a folder "
            "that can be written"
        ) from error
    return path
