"""Signals that end a run: what it has is kept, and further ones wait until that is written."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

_ENDING = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)
"""From the keyboard, from who manages processes, from a terminal that went away."""
_PAUSE = 1.0
"""After one that was raised, others wait for so long even if nobody holds them, s: meanwhile the
run is on its way out."""


class Interrupted(KeyboardInterrupt):
    """A signal asks to end.

    Parameters
    ----------
    number : int
        Of the signal.
    """

    def __init__(self, number: int) -> None:
        super().__init__(signal.Signals(number).name)
        self.number = number


class Signals:
    """What comes in, and whether it may end what goes on: one a process.

    Attributes
    ----------
    received : int or None
        Number of the first signal that came while somebody listened.
    listening : bool
    """

    def __init__(self) -> None:
        self.received: int | None = None
        self.listening = False
        self._holds = 0
        self._quiet_until = -1.0
        self._usual: Any = None

    @contextmanager
    def heard(self) -> Iterator[None]:
        """Let SIGINT, SIGTERM and SIGHUP raise `Interrupted` in the main thread meanwhile.

        One that the process was started to ignore, as ``nohup`` does, stays ignored.
        """
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {number: signal.getsignal(number) for number in _ENDING}
        self.received, self.listening, self._holds = None, True, 0
        self._quiet_until = -1.0
        try:
            for number, handler in before.items():
                if handler is not signal.SIG_IGN:
                    signal.signal(number, self._heard)
            yield
        finally:
            self.listening = False
            for number, handler in before.items():
                signal.signal(number, handler)

    def _heard(self, number: int, frame: FrameType | None) -> None:
        if self.received is None:
            self.received = number
        now = time.monotonic()
        if self._holds or now < self._quiet_until:
            return
        self._quiet_until = now + _PAUSE
        raise Interrupted(number)

    def check(self) -> None:
        """Raise `Interrupted` if a signal has come, be it while they were held."""
        if self.received is not None:
            raise Interrupted(self.received)

    def hold(self) -> None:
        """Let signals wait until `release`; nested holds count.

        Where nobody listens, as in a program of one's own, an interrupt from the keyboard waits.
        """
        self._holds += 1
        if self._holds > 1 or self.listening:
            return
        if threading.current_thread() is threading.main_thread():
            usual = signal.getsignal(signal.SIGINT)
            if usual is signal.default_int_handler:
                self._usual = usual
                self.received = None
                signal.signal(signal.SIGINT, self._noted)

    def _noted(self, number: int, frame: FrameType | None) -> None:
        self.received = number

    def release(self, ended: bool = False) -> None:
        """Let signals through again, and where nobody listens one that has waited.

        Parameters
        ----------
        ended : bool
            Whether a signal has ended the run already: one that has waited wanted the same.
        """
        self._holds = max(0, self._holds - 1)
        if self.listening:
            self._quiet_until = time.monotonic() + _PAUSE
        elif not self._holds and self._usual is not None:
            signal.signal(signal.SIGINT, self._usual)
            self._usual = None
            if (waited := self.received) is not None and not ended:
                self.received = None
                raise Interrupted(waited)
            self.received = None


SIGNALS = Signals()


def interrupts(failure: BaseException) -> bool:
    """Return whether it is a signal that has ended something; a part may raise the like of one."""
    ours = Interrupted if SIGNALS.listening else KeyboardInterrupt
    return isinstance(failure, ours)


class Hold:
    """Signals wait from `begin` to the end of a ``with`` statement.

    Attributes
    ----------
    ended : bool
        Whether a signal has ended what is done here (see `Signals.release`).
    """

    def __init__(self) -> None:
        self.ended = self._begun = False

    def __enter__(self) -> Hold:
        return self

    def begin(self) -> None:
        """Let signals wait from now on."""
        if not self._begun:
            self._begun = True
            SIGNALS.hold()

    def __exit__(self, *raised: object) -> None:
        """Let them through again."""
        if self._begun:
            SIGNALS.release(self.ended)
