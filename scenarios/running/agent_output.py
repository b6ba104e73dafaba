"""What an agent answered, looked at before it goes on: a user's class may return anything."""

from __future__ import annotations

import math
from typing import Any

import numpy as np


class AgentError(Exception):
    """An agent's answer cannot be used; the message says what it was and what would be right."""


def of_kind(answer: Any, kind: type, method: str) -> None:
    """Raise `AgentError` unless an answer is of a kind."""
    if not isinstance(answer, kind):
        raise AgentError(f"{method}() gave {answer!r}; it must be a {kind.__name__}")


def pair(answer: Any, method: str, expected: str) -> list[float]:
    """Return the two numbers of an answer.

    Parameters
    ----------
    answer : Any
        What the agent returned.
    method : str
        Method that returned it.
    expected : str
        What it should be, in words.

    Raises
    ------
    AgentError
        If it is not an array of two finite numbers.
    """
    if not isinstance(answer, np.ndarray) or answer.shape != (2,):
        got = f"an array of shape {answer.shape}" if hasattr(answer, "shape") else repr(answer)
        raise AgentError(
            f"{method}() gave {got}; it must be {expected}, a NumPy array of shape (2,)"
        )
    values: list[float] = answer.tolist()
    first, second = values
    if not (math.isfinite(first) and math.isfinite(second)):
        raise AgentError(f"{method}() gave {values}; {expected} must be finite")
    return values
