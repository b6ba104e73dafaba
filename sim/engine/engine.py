"""PyBullet itself: a quiet import, clients, bodies from text, and what a constraint reports.

PyBullet has no type stubs; its functions are reached through `engine`, whose attributes are Any.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import importlib
import os
import sys
import threading
import weakref
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from ..basics.errors import InputError

_QUIET = threading.RLock()


@contextmanager
def quiet(*descriptors: int) -> Iterator[None]:
    """Keep what C code prints out of the given file descriptors (1 output, 2 error).

    They are pointed at the null device meanwhile. C's own buffers are flushed before they are
    pointed back, else the text would come out when the process ends.
    """
    # One at a time: a second thread would take the null device for the original.
    with _QUIET:
        yield from _pointed_away(descriptors)


def _pointed_away(descriptors: tuple[int, ...]) -> Iterator[None]:
    c_library = ctypes.CDLL(None) if os.name == "posix" else ctypes.CDLL("msvcrt")
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, OSError, ValueError):  # none, or closed
            stream.flush()
    c_library.fflush(None)
    kept: dict[int, int] = {}
    null = os.open(os.devnull, os.O_WRONLY)
    try:
        for descriptor in descriptors:
            with suppress(OSError):  # the process was started without it
                kept[descriptor] = os.dup(descriptor)
                os.dup2(null, descriptor)
        yield
    finally:
        c_library.fflush(None)
        for descriptor, copy in kept.items():
            os.dup2(copy, descriptor)
            os.close(copy)
        os.close(null)


with quiet(1, 2):  # it announces its build time
    engine = importlib.import_module("pybullet")


_opened: Counter[int] = Counter()
"""How often each client id was given out: a freed one is given out again."""


def connect(gui: bool = False) -> int:
    """Open a world of one's own and return its client id.

    Raises
    ------
    InputError
        If a window is asked for and there is no display.
    """
    if gui and sys.platform.startswith("linux") and not _display_opens():
        raise InputError(  # the engine would end the whole process
            f"no window can be opened: display {os.environ.get('DISPLAY', '')!r} does not answer; "
            "set DISPLAY, or run without the window"
        )
    with quiet(1):
        client: int = engine.connect(engine.GUI if gui else engine.DIRECT)
    if client < 0 and gui:
        raise InputError("no window can be opened: another one is open in this process")
    if client < 0:
        raise InputError(
            "the engine opens no further world in this process: close environments that are not "
            "needed any more"
        )
    _opened[client] += 1
    return client


def free_with(owner: object, client: int) -> Callable[[], object]:
    """Let a client be freed with the object that owns it.

    Returns
    -------
    callable
        Frees it at once; further calls do nothing.
    """
    end = weakref.finalize(owner, _free, client, _opened[client])
    end.atexit = False  # by then the engine may be gone
    return end


def _free(client: int, opened: int) -> None:
    if _opened[client] == opened:
        disconnect(client)


def _display_opens() -> bool:
    name = ctypes.util.find_library("X11")
    if name is None:
        return False
    x11 = ctypes.CDLL(name)
    x11.XOpenDisplay.restype = ctypes.c_void_p
    display = x11.XOpenDisplay(None)
    if display is None:
        return False
    x11.XCloseDisplay(ctypes.c_void_p(display))
    return True


def disconnect(client: int) -> None:
    """Free a client and everything in it; one that is gone already is no error."""
    if engine.isConnected(client):
        with quiet(1):
            engine.disconnect(client)


def load(client: int, urdf: str, *, fixed: bool = True, flags: int = 0) -> int:
    """Load a URDF given as text, and return the body id.

    Parameters
    ----------
    client : int
        Where to load it.
    urdf : str
    fixed : bool
        Whether its root link is held.
    flags : int
        Of the engine's `loadURDF`.
    """
    with TemporaryDirectory() as folder, quiet(1):
        path = Path(folder, "body.urdf")
        # The engine's reader breaks a line of more than 8191 characters, and drops one there.
        path.write_text(urdf.replace("><", ">\n<"), encoding="utf-8")
        body: int = engine.loadURDF(
            str(path), useFixedBase=fixed, flags=flags, physicsClientId=client
        )
    return body


class WorldState:
    """State of everything in a client, kept by the engine for as long as this object lives."""

    def __init__(self, client: int) -> None:
        self._client = client
        self._id: int = engine.saveState(client)
        weakref.finalize(self, _forget, self._id, client, _opened[client])

    def restore(self) -> None:
        """Put the client back into that state, bit for bit."""
        engine.restoreState(stateId=self._id, physicsClientId=self._client)


def _forget(state: int, client: int, opened: int) -> None:
    if _opened[client] == opened and engine.isConnected(client):
        engine.removeState(state, client)


def force_on_parent(kind: int, reaction: tuple[float, ...]) -> tuple[float, float, float]:
    """Convert what `getConstraintState` reports to the child's force on the parent.

    The engine reports the force on the parent for JOINT_FIXED, and the force on the child for
    JOINT_POINT2POINT (a mass hanging from a held parent reads -m g and +m g).

    Parameters
    ----------
    kind : int
        ``engine.JOINT_FIXED`` or ``engine.JOINT_POINT2POINT``.
    reaction : tuple of float
        As reported, N, world axes; torques after the first three are ignored.

    Returns
    -------
    (fx, fy, fz)
        N, world axes.
    """
    if kind == engine.JOINT_POINT2POINT:
        return -reaction[0], -reaction[1], -reaction[2]
    return reaction[0], reaction[1], reaction[2]
