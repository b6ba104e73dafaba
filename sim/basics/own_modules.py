"""Modules of a user's own: found beside a scenario by who names them, and by one another.

`sys.path` is never touched. A ``pandas.py`` beside a scenario would otherwise be executed by the
first library that looks whether pandas is installed.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import FrameType, ModuleType

_named: ContextVar[str | None] = ContextVar("named", default=None)
"""The module that is being imported because a name says so."""
_folders: list[str] = []
_own: dict[Path, str] = {}
"""The folder of every module that was found here, by its file, or by its own folder."""


def look_in(folder: str | Path) -> None:
    """Let ``module:Class`` be found in a folder, before those that were given earlier."""
    path = str(Path(folder).resolve())
    if path in _folders:
        _folders.remove(path)
    _folders.insert(0, path)


def folders() -> list[str]:
    """Return where modules are looked for that are not installed: the working folder last."""
    here = str(Path.cwd())
    return [*(folder for folder in _folders if folder != here), here]


def named_module(name: str) -> ModuleType:
    """Import a module that is installed, or lies in one of `folders`."""
    if not any(isinstance(finder, _BesideFinder) for finder in sys.meta_path):
        sys.meta_path.append(_BesideFinder())  # last: what is installed is found first
    with _naming(name.partition(".")[0]):
        return importlib.import_module(name)


@contextmanager
def _naming(name: str) -> Iterator[None]:
    token = _named.set(name)
    try:
        yield
    finally:
        _named.reset(token)


class _BesideFinder(MetaPathFinder):
    """Finds a top-level module for who named it, and for a module found so, in the same folder."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        """See `importlib.abc.MetaPathFinder.find_spec`."""
        if path is not None:
            return None
        places = folders()
        if fullname != _named.get():
            asking = _importing_file(sys._getframe(1))
            # The working folder may hold a whole environment: what is installed there is not mine.
            places = [_own[place] for place in (asking, *asking.parents) if place in _own]
        found = PathFinder.find_spec(fullname, places) if places else None
        for place in _places(found):
            _own[place] = str(place.parent)
        return found


def _places(spec: ModuleSpec | None) -> list[Path]:
    """Return the file of a module, or the folders of a package."""
    if spec is None:
        return []
    inside = spec.submodule_search_locations
    return [Path(each) for each in (inside or filter(None, [spec.origin]))]


def _importing_file(frame: FrameType | None) -> Path:
    """Return the file whose code asks for an import."""
    while frame is not None:
        file = frame.f_code.co_filename
        if not (file.startswith("<frozen importlib") or file == importlib.__file__):
            return Path(file)
        frame = frame.f_back
    return Path()
