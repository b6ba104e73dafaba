"""One law for one human and for a batch: the same few functions over floats and over arrays.

A model's law written in these costs a tenth of array operations for one human, and broadcasts
for ten thousand.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from cowalk.sim.motion import Array

Value = Any
"""A float of one human, or an array of shape (...) of a batch."""


@dataclass(frozen=True, slots=True)
class Elementwise:
    """Functions that a law may call on a `Value`.

    Attributes
    ----------
    parts : callable
        From an array of shape (..., n) to n values.
    pair : callable
        From two values to an array of shape (..., 2).
    where : callable
        ``where(condition, a, b)``; all three are evaluated.
    sin, cos, sqrt, atan2, minimum, maximum : callable
    """

    parts: Callable[[Array], Any]
    pair: Callable[[Value, Value], Array]
    where: Callable[[Any, Any, Any], Any]
    sin: Callable[[Value], Value]
    cos: Callable[[Value], Value]
    sqrt: Callable[[Value], Value]
    atan2: Callable[[Value, Value], Value]
    minimum: Callable[[Value, Value], Value]
    maximum: Callable[[Value, Value], Value]

    def clip(self, value: Value, low: Value, high: Value) -> Value:
        """Return the value brought into [low, high]."""
        return self.minimum(self.maximum(value, low), high)


def _stack(first: Value, second: Value) -> Array:
    out = np.empty((*np.broadcast_shapes(np.shape(first), np.shape(second)), 2))
    out[..., 0], out[..., 1] = first, second
    return out


FLOATS = Elementwise(
    parts=lambda array: array.tolist(),
    pair=lambda first, second: np.array((first, second)),
    where=lambda condition, a, b: a if condition else b,
    sin=math.sin,
    cos=math.cos,
    sqrt=math.sqrt,
    atan2=math.atan2,
    minimum=min,
    maximum=max,
)
ARRAYS = Elementwise(
    parts=lambda array: np.moveaxis(array, -1, 0),
    pair=_stack,
    where=np.where,
    sin=np.sin,
    cos=np.cos,
    sqrt=np.sqrt,
    atan2=np.arctan2,
    minimum=np.minimum,
    maximum=np.maximum,
)


def elementwise(pose: Array) -> Elementwise:
    """Return the functions for a pose of one human, shape (3,), or of a batch, (..., 3)."""
    return FLOATS if pose.ndim == 1 else ARRAYS
