"""Whether code that a file names may be imported: only where the user says so."""

from __future__ import annotations

import os
from collections.abc import Collection
from pathlib import Path
from typing import Any

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.own_modules import look_in

from ..yaml_text.document import Document, Fault, KeyPath, dotted
from .overrides import sections

VARIABLE = "COWALK_TRUST"
"""Environment variable that names folders whose files are trusted, those beneath them too."""
CURE = (
    "if you trust who wrote it, say --trust (pytest: --cowalk-trust; Python: trust=True), "
    f"or name its folder in {VARIABLE}"
)


def code_named(data: Any) -> list[tuple[KeyPath, str]]:
    """Return place and ``module:Class`` of all code that plain data name, names expanded."""
    found: list[tuple[KeyPath, str]] = []
    for part, _, path, value in sections(data):
        name = value.get(part.named_by) if isinstance(value, dict) else value
        if isinstance(name, str) and ":" in name and not part.preset:
            found.append(((*path, part.named_by) if isinstance(value, dict) else path, name))
    return found


def untrusted(
    file: Path,
    document: Document,
    named: list[tuple[KeyPath, str]],
    trust: bool,
    said: Collection[str] = (),
) -> Fault | None:
    """Return what keeps the code that a file names from being imported; None if nothing does.

    Where the file is trusted its own folder is searched for modules from now on.

    Parameters
    ----------
    file : Path
    document : Document
    named : list of (tuple, str)
        See `code_named`.
    trust : bool
        Whether the user trusts this file.
    said : collection of str
        Names that the user said themselves: naming code is to trust it.

    Raises
    ------
    InputError
        If the environment variable does not name folders.
    """
    if not named:
        return None
    if trust or is_trusted(file):
        look_in(file.resolve().parent)
        return None
    foreign = [(path, name) for path, name in named if name not in said]
    if not foreign:
        return None
    path, _ = min(foreign, key=lambda item: document.line(item[0]))
    listed = ", ".join(f"{dotted(place)} = {name!r}" for place, name in foreign[:_SHOWN])
    more = f" and {len(foreign) - _SHOWN} more" if foreign[_SHOWN:] else ""
    return Fault(path, f"names code, not checked: {listed}{more}; {CURE}")


_SHOWN = 3


def is_trusted(file: Path) -> bool:
    """Return whether a file lies, links followed, in a folder that the user trusts.

    Raises
    ------
    InputError
        If the environment variable holds what is no whole path of a folder.
    """
    folders = []
    for entry in filter(None, os.environ.get(VARIABLE, "").split(os.pathsep)):
        folder = Path(entry).expanduser()
        if not folder.is_absolute():
            raise InputError(
                f"{VARIABLE}: {entry!r} is not absolute; name folders as /home/me/work"
            )
        folders.append(folder.resolve())
    return any(folder in file.resolve().parents for folder in folders)
