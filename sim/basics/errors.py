"""Errors a user can act on: one line, saying what was given and what would be right."""

from __future__ import annotations

from typing import Any

Step = str | int
"""A key, or the number of a list's entry from 0."""


class InputError(ValueError):
    """Something the user gave is wrong.

    Parameters
    ----------
    message : str
        One line that names the cure. It begins with the place, if there is one:
        ``mount.position = (0, 9): must be 3 finite numbers``.
    at : tuple of str and int
        The place as data, from what was being made inwards: ``("mount", "position")``.
    """

    def __init__(self, message: str, at: tuple[Step, ...] = ()) -> None:
        super().__init__(message)
        self.at = at

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (*self.args, self.at)

    def inside(self, *steps: Step) -> InputError:
        """Return it as an error of what holds this: at ``steps`` and then where it was."""
        outer = ".".join(str(step) for step in steps)
        return InputError(f"{outer}{'.' if self.at else ': '}{self}", (*steps, *self.at))


class SimulationError(RuntimeError):
    """The simulation cannot go on (a force is not finite, a body diverged)."""


class PartError(Exception):
    """A replaceable part gave what cannot be used.

    Parameters
    ----------
    part : object
        The part to blame.
    message : str
        What it gave, and what it must be.
    """

    def __init__(self, part: object, message: str) -> None:
        super().__init__(message)
        self.part = part


def told(error: BaseException) -> str:
    """Return kind and text of an error in one line, whatever a user's class makes of its text."""
    kind = type(error).__name__
    try:
        text = " ".join(str(error).split())
    except BaseException:  # it may raise anything
        return f"{kind}, whose text cannot be made"
    text = text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."
    return f"{kind}: {text}" if text else kind


_LONGEST = 500
