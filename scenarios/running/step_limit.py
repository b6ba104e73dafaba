"""A control step that takes too long is ended: a part of a user's may never return."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.validators import require_range

LONGEST = 86_400.0
"""A limit beyond a day is none, s."""
_AGAIN = 1.0
"""A part that swallows it is told again after so long, s."""


class StepTooLong(BaseException):
    """A part has not returned within the limit; no `Exception`, which parts may catch."""


class StepLimit:
    """Raises `StepTooLong` in a step that takes longer than a limit.

    It interrupts Python code and what waits for the system, not compiled code that never
    returns: that has to be killed, which leaves the trace.

    Parameters
    ----------
    seconds : float or None
        None lets steps take as long as they like.

    Raises
    ------
    InputError
        If it makes no sense, or this thread or system has no such timer.
    """

    def __init__(self, seconds: float | None) -> None:
        self._seconds = seconds
        if seconds is None:
            return
        require_range("step_timeout", seconds, (0.001, LONGEST, "s"))
        main = threading.current_thread() is threading.main_thread()
        if not (main and hasattr(signal, "setitimer")):
            raise InputError(
                "step_timeout: only the main thread has such a timer, and not on Windows",
                ("step_timeout",),
            )

    @contextmanager
    def heeded(self) -> Iterator[None]:
        """Let the timer raise meanwhile."""
        if self._seconds is None:
            yield
            return
        before: Any = signal.signal(signal.SIGALRM, self._over)
        try:
            yield
        finally:
            self.stop()
            signal.signal(signal.SIGALRM, before)

    def start(self) -> None:
        """Begin a step."""
        if self._seconds is not None:
            signal.setitimer(signal.ITIMER_REAL, self._seconds, _AGAIN)

    def stop(self) -> None:
        """End a step."""
        if self._seconds is not None:
            signal.setitimer(signal.ITIMER_REAL, 0.0)

    def _over(self, number: int, frame: FrameType | None) -> None:
        raise StepTooLong(f"it did not return within {self._seconds:g} s")
