"""What an agent answered, looked at before it goes on: a user's class may return anything."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from cowalk.agents.basics.protocols import Belief, Truth
from cowalk.sim.basics.errors import PartError
from cowalk.sim.basics.motion import TwistBounds
from cowalk.sim.basics.validators import are_numbers, said

_FORCE = "the force [fx, fy] in N"
_TWIST = "the twist [v, omega] in m/s and rad/s"


def require_force(human: object, answer: Any) -> None:
    """Refuse what is no force of a human.

    Raises
    ------
    PartError
        If it is not an array of two finite numbers.
    """
    _finite_pair(human, "act", answer, _FORCE)


def require_twist(automation: object, answer: Any) -> None:
    """Refuse what is no twist of an automation.

    Raises
    ------
    PartError
        If it is not an array of two finite numbers.
    """
    _finite_pair(automation, "act", answer, _TWIST)


def require_truth(human: object, truth: Any, bounds: TwistBounds) -> None:
    """Refuse what is no truth of a human; NaN is unknown, and right.

    Raises
    ------
    PartError
        If it is no `Truth`, one of its arrays is not two numbers, the wish lies outside of the
        bounds or the stubbornness outside of [0, 1].
    """
    if not isinstance(truth, Truth):
        raise PartError(human, f"truth() gave {said(truth)}; it must be a Truth")
    for name in ("stubbornness", "wish", "strength", "limit"):
        value = getattr(truth, name)
        if not isinstance(value, np.ndarray) or value.shape != (2,):
            raise PartError(human, f"truth().{name} is {said(value)}; it must be {_PAIR}")
    for name in ("gain", "delay"):
        value = getattr(truth, name)
        if not isinstance(value, float | int | np.number | np.ndarray) or np.ndim(value):
            raise PartError(human, f"truth().{name} is {said(value)}; it must be one number")
    lows, highs = bounds.lower, bounds.upper
    for values, unit, name, low, high in (
        (truth.wish.tolist(), _UNITS, "wish", lows, highs),
        (truth.stubbornness.tolist(), ("", ""), "stubbornness", (0.0, 0.0), (1.0, 1.0)),
    ):
        for i, value in enumerate(values):
            if value < low[i] - _ROUNDING or value > high[i] + _ROUNDING:
                raise PartError(
                    human,
                    f"truth().{name} in {_DIMENSIONS[i]} is {value:.4g}{unit[i]}; it must be "
                    f"from {low[i]:g} to {high[i]:g}{unit[i]}: what is asked for beyond is "
                    "insistence, clip it",
                )


_DIMENSIONS, _UNITS = ("v", "omega"), (" m/s", " rad/s")
_ROUNDING = 1e-9


def require_belief(automation: object, belief: Any, columns: Mapping[str, str]) -> None:
    """Refuse what is no belief of an automation; NaN is no opinion, and right.

    Raises
    ------
    PartError
        If it is no `Belief`, one of its arrays is not two numbers, or it brings a number of
        which ``columns`` says nothing.
    """
    if not isinstance(belief, Belief):
        raise PartError(automation, f"belief() gave {said(belief)}; it must be a Belief")
    for name in _PAIRS:
        value = getattr(belief, name)
        if not isinstance(value, np.ndarray) or value.shape != (2,):
            raise PartError(automation, f"belief().{name} is {said(value)}; it must be {_PAIR}")
        if value.dtype.kind not in _REAL:
            what = f"belief().{name} is an array of {value.dtype}; it must be real numbers"
            raise PartError(automation, what)
    for name, low, high in _RANGES:
        for value in getattr(belief, name).tolist():
            if value < low or value > high:  # and NaN is neither
                what = f"belief().{name} has {value:.4g}; it must lie between {low:g} and {high:g}"
                raise PartError(automation, what)
    for name in _NUMBERS:
        value = getattr(belief, name)
        if not are_numbers(value):
            raise PartError(automation, f"belief().{name} is {said(value)}; it must be one number")
    if not isinstance(belief.extras, Mapping):
        found = f"belief().extras is {said(belief.extras)}"
        raise PartError(automation, f"{found}; it must be numbers by name")
    for name, value in belief.extras.items():
        if name not in columns:
            known = ", ".join(columns) or "nothing"
            raise PartError(automation, f"belief().extras has {name!r}; columns declares {known}")
        if not are_numbers(value):
            found = f"belief().extras has {name} = {said(value)}"
            raise PartError(automation, f"{found}; it must be one number")


_REAL = "fiu"
"""Kinds of arrays that are real numbers."""
_ROUNDING = 1e-9
_RANGES = (
    ("stubbornness", -_ROUNDING, 1.0 + _ROUNDING),
    ("stubbornness_deviation", 0.0, math.inf),
    ("human_wish_deviation", 0.0, math.inf),
)
"""What lies within which limits, if it is a number."""
_PAIR = "a NumPy array of shape (2,)"
_PAIRS = (
    "stubbornness",
    "stubbornness_deviation",
    "stubbornness_smoothed",
    "human_wish",
    "human_wish_deviation",
    "wish",
)
_NUMBERS = ("interaction", "interaction_smoothed", "utility_loss", "target_utility", "negotiation")


def _finite_pair(part: object, method: str, answer: Any, expected: str) -> None:
    if not isinstance(answer, np.ndarray) or answer.shape != (2,):
        raise PartError(part, f"{method}() gave {said(answer)}; it must be {expected}, {_PAIR}")
    if answer.dtype.kind not in _REAL:
        what = f"{method}() gave an array of {answer.dtype}; {expected} must be real numbers"
        raise PartError(part, what)
    first, second = values = answer.tolist()
    if not (math.isfinite(first) and math.isfinite(second)):
        raise PartError(part, f"{method}() gave {values}; {expected} must be finite")
