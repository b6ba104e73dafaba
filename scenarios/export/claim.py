"""A folder that one run at a time writes into; its files come into place together, at the end.

While it runs, what there is lies in a folder ``unfinished`` within. That is in the same file
system, so that moving cannot fail half-way for want of space, and where one looks for it.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Collection
from contextlib import suppress
from pathlib import Path

from cowalk.sim.basics.errors import InputError

from .folder import cannot_write

try:
    import fcntl
except ImportError:  # not on Windows: two runs at once are not noticed there
    fcntl = None  # type: ignore[assignment]

UNFINISHED = "unfinished"
_OLD, _REPLACED = "old", "replaced"
"""Where old files go, and what that is called once all of them are there."""


class Claim:
    """A folder while it is written to.

    Parameters
    ----------
    folder : str or Path
        Created if need be.
    names : collection of str
        Every file that may come into place; those of them that are there will be replaced.
    begun : str
        Name of the file that is there if what was left behind is worth keeping.

    Attributes
    ----------
    folder, place : Path
        The folder, and where to write meanwhile.
    kept : Path or None
        What a run that was killed has left, moved out of the way.
    finished : bool
        Whether a run was killed while its files were moved, which was then done.

    Raises
    ------
    InputError
        If the folder cannot be written, another run writes to it, or a folder has the name of one
        of the files.
    """

    def __init__(self, folder: str | Path, names: Collection[str], begun: str) -> None:
        self.folder, self._names, self._begun = Path(folder), tuple(names), begun
        self.place = self.folder / UNFINISHED
        self.kept: Path | None = None
        self.finished = False
        self._lock: int | None = None
        try:
            self._made = _missing(self.folder)
            self.folder.mkdir(parents=True, exist_ok=True)
            self._lock = _locked(self.folder)
            self._clear()
            self.place.mkdir()
        except (OSError, UnicodeError) as error:
            self.release()
            raise cannot_write(folder, error) from error
        except InputError:
            self.release()
            raise

    def _clear(self) -> None:
        """Make way: finish or keep what a run has left that was killed."""
        for name in self._names:
            if (self.folder / name).is_dir():
                raise InputError(f"{self.folder / name} is a folder: a file is to be written there")
        if not os.path.lexists(self.place):
            return
        ours = {*self._names}
        if any((self.place / name).is_dir() for name in (_OLD, _REPLACED)):
            _exchange(self.folder, self._names, [])
            _remove(self.place, self._begun)
            self.finished = True
        elif (self.place / self._begun).is_file():
            numbers = (self.folder / f"{UNFINISHED}-{number}" for number in range(1, 10_000))
            self.kept = next(path for path in numbers if not os.path.lexists(path))
            self.place.rename(self.kept)
        elif self.place.is_dir() and {each.name for each in self.place.iterdir()} <= ours:
            shutil.rmtree(self.place)  # killed before it had anything to keep
        else:
            raise InputError(f"{self.place} is in the way: move it, or give another folder")

    def commit(self) -> None:
        """Move what was written into place, and what it replaces away: all of it or nothing.

        Files of the user's stay as they are.

        Raises
        ------
        InputError
            If the folder cannot be written; it is then as it was.
        """
        done: list[tuple[Path, Path]] = []
        try:
            (self.place / _OLD).mkdir()
            _exchange(self.folder, self._names, done)
        except OSError as error:
            for before, after in reversed(done):
                with suppress(OSError):
                    after.rename(before)
            with suppress(OSError):
                (self.place / _OLD).rmdir()
            raise cannot_write(self.folder, error) from error
        _remove(self.place, self._begun)

    def discard(self) -> None:
        """Remove what was written so far, and the folder if it was made for that."""
        shutil.rmtree(self.place, ignore_errors=True)
        for path in self._made:
            with suppress(OSError):  # it holds something by now
                path.rmdir()

    def release(self) -> None:
        """Let others write to the folder."""
        lock, self._lock = self._lock, None
        if lock is not None:
            os.close(lock)


def _exchange(folder: Path, names: Collection[str], done: list[tuple[Path, Path]]) -> None:
    """Move old files out of a folder, then new ones in; note what was moved.

    At no time old and new ones are mixed, and at any time it can be taken up again.
    """
    place = folder / UNFINISHED

    def move(source: Path, target: Path) -> None:
        for name in names:
            if os.path.lexists(source / name):
                (source / name).rename(target / name)
                done.append((source / name, target / name))

    if (place / _OLD).is_dir():
        move(folder, place / _OLD)
        (place / _OLD).rename(place / _REPLACED)
        done.append((place / _OLD, place / _REPLACED))
    move(place, folder)


def _remove(place: Path, begun: str) -> None:
    """Remove what is not needed any more; first what would be taken for an unfinished run."""
    with suppress(OSError):
        (place / begun).unlink()
    shutil.rmtree(place, ignore_errors=True)


def _locked(folder: Path) -> int | None:
    """Lock a folder itself, for as long as the process lives; None where that is not possible."""
    if fcntl is None:
        return None
    lock = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(lock)
        raise InputError(
            f"{folder}: another run is writing there; give another folder, or wait for it"
        ) from None
    except OSError:  # some network file systems lock no folders
        os.close(lock)
        return None
    return lock


def _missing(folder: Path) -> list[Path]:
    """Return the folders that have to be made, the innermost first."""
    return [path for path in (folder, *folder.parents) if not os.path.lexists(path)]
