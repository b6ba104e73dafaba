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
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array

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
        ``pair(like, a, b)``: two values as an array of shape (..., 2), the leading axes being
        those of the array ``like``.
    where : callable
        ``where(condition, a, b)``; all three are evaluated.
    any : callable
        Whether a condition holds, for anybody of a batch.
    exp, sin, cos, atan2, sqrt, minimum, maximum : callable
    """

    parts: Callable[[Array], Any]
    pair: Callable[[Array, Value, Value], Array]
    where: Callable[[Any, Any, Any], Any]
    any: Callable[[Any], bool]
    exp: Callable[[Value], Value]
    sin: Callable[[Value], Value]
    cos: Callable[[Value], Value]
    atan2: Callable[[Value, Value], Value]
    sqrt: Callable[[Value], Value]
    minimum: Callable[[Value, Value], Value]
    maximum: Callable[[Value, Value], Value]

    def clip(self, value: Value, low: Value, high: Value) -> Value:
        """Return the value brought into [low, high]."""
        return self.minimum(self.maximum(value, low), high)


def _stack(like: Array, first: Value, second: Value) -> Array:
    out = np.empty((*like.shape[:-1], 2))
    out[..., 0], out[..., 1] = first, second
    return out


FLOATS = Elementwise(
    parts=lambda array: array.tolist(),
    pair=lambda like, first, second: np.array((first, second)),
    where=lambda condition, a, b: a if condition else b,
    any=bool,
    exp=math.exp,
    sin=math.sin,
    cos=math.cos,
    atan2=math.atan2,
    sqrt=math.sqrt,
    minimum=min,
    maximum=max,
)
ARRAYS = Elementwise(
    # Contiguous, since a law reads each value many times.
    parts=lambda array: [array[..., i].copy() for i in range(array.shape[-1])],
    pair=_stack,
    where=np.where,
    any=lambda condition: bool(np.any(condition)),
    exp=np.exp,
    sin=np.sin,
    cos=np.cos,
    atan2=np.arctan2,
    sqrt=np.sqrt,
    minimum=np.minimum,
    maximum=np.maximum,
)


def elementwise(array: Array) -> Elementwise:
    """Return the functions for an array of one human, shape (n,), or of a batch, (..., n)."""
    return FLOATS if array.ndim == 1 else ARRAYS


def components(array: ArrayLike) -> tuple[Value, Value]:
    """Return the two values of an array of shape (..., 2)."""
    values = np.asarray(array, dtype=float)
    first, second = elementwise(values).parts(values)
    return first, second
