"""Files that a scenario file names: relative paths begin where it lies itself."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, get_args

from cowalk.sim.basics.file_names import names_file

from ..yaml_text.document import KeyPath
from .building import hints_of
from .overrides import sections
from .parts import PARAMETERS


def begin_paths_at(folder: Path, data: Any, counts: Callable[[KeyPath], bool]) -> None:
    """Turn relative paths among the parameters of parts into absolute ones, in place.

    Which parameters are paths their annotations say (`cowalk.sim.basics.file_names.names_file`).

    Parameters
    ----------
    folder : Path
        Where the scenario file lies.
    data : object
        Plain data of the scenario, names expanded.
    counts : callable
        Whether the value at a place is to be changed: one from the command line is not.
    """
    for part, _, at, section in sections(data):
        parameters = section.get(PARAMETERS) if isinstance(section, dict) else None
        if part.preset or not isinstance(parameters, dict) or not _holds_text(parameters):
            continue  # imports nothing that is not needed
        try:
            hints = hints_of(part.registry().get(section[part.named_by]))
        except Exception:  # a user's module may raise anything; who checks the part reports it
            continue
        for place, holder, key in _paths(parameters, hints, (*at, PARAMETERS)):
            path = Path(holder[key]).expanduser()
            if counts(place) and not path.is_absolute():
                holder[key] = str(folder / path)


def _holds_text(value: Any) -> bool:
    if isinstance(value, dict):
        return any(_holds_text(item) for item in value.values())
    return isinstance(value, str)


def _paths(
    values: dict[str, Any], hints: Mapping[str, Any], at: KeyPath
) -> Iterator[tuple[KeyPath, dict[str, Any], str]]:
    """Yield the place of every path, and the mapping and the key that hold it."""
    for key, value in values.items():
        hint = hints.get(key)
        if isinstance(value, str) and names_file(hint):
            yield (*at, key), values, key
        elif isinstance(value, dict):
            for kind in (hint, *get_args(hint)):
                if isinstance(kind, type) and dataclasses.is_dataclass(kind):
                    yield from _paths(value, hints_of(kind), (*at, key))
