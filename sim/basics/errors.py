"""Errors a user can act on: one line, saying what was given and what would be right."""

from __future__ import annotations


class InputError(ValueError):
    """Something the user gave is wrong; the message is one line and names the cure."""


class SimulationError(RuntimeError):
    """The simulation cannot go on (a force is not finite, a body diverged)."""
