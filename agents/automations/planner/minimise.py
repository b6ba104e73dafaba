"""Where a cost over an interval is least, for any number of lanes."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray

from cowalk.sim.basics.motion import Array

_NEIGHBOURS = np.array([-1, 0, 1])

_FLAT = 1e-200


def minimise(cost: Callable[[Array], Array], low: Array, high: Array, points: int = 33) -> Array:
    """Return where a cost over an interval is least: two grids, then a parabola's vertex.

    A grid finds the lowest of several valleys and a minimum at a bound, which bracketing
    methods do not, and costs a handful of array operations for any number of lanes.

    Parameters
    ----------
    cost : callable
        Takes an array of shape (..., n) and returns the cost of each element.
    low, high : ndarray, shape (...)
    points : int
        Number of points of each grid; the second covers two cells of the first.

    Returns
    -------
    ndarray, shape (...)
    """
    left, width = low[..., None], (high - low)[..., None]
    left, width = beside_least(cost(left + width * _grid(points)), left, width)
    return vertex(cost(left + width * _grid(points)), left, width)


def beside_least(value: Array, left: Array, width: Array) -> tuple[Array, Array]:
    """Return left end and width of the two cells of a grid beside its least value.

    Parameters
    ----------
    value : ndarray, shape (..., n)
        At evenly spaced places.
    left, width : ndarray, shape (..., 1)
        Where they begin, and how far they reach.

    Returns
    -------
    (ndarray, ndarray), each of shape (..., 1)
    """
    cell = width / (value.shape[-1] - 1)
    return left + (_inner_least(value) - 1) * cell, 2.0 * cell


def vertex(value: Array, left: Array, width: Array) -> Array:
    """Return where the parabola through the least value of a grid and its neighbours is least.

    Parameters
    ----------
    value, left, width : ndarray
        See `beside_least`.

    Returns
    -------
    ndarray, shape (...)
        No farther than a neighbour.
    """
    at = _inner_least(value)
    lowest = np.take_along_axis(value, at + _NEIGHBOURS, axis=-1)
    before, here, after = lowest[..., 0], lowest[..., 1], lowest[..., 2]
    bend = before - 2.0 * here + after
    # Where it does not bend upwards the least value is at an end, which the division finds too.
    shift = 0.5 * (before - after) / np.maximum(bend, _FLAT)
    inside = np.minimum(np.maximum(shift, -1.0), 1.0)  # np.clip takes longer
    cell = width[..., 0] / (value.shape[-1] - 1)
    return np.asarray(left[..., 0] + (at[..., 0] + inside) * cell)


def _inner_least(value: Array) -> NDArray[np.int_]:
    """Return the number of the least value that has neighbours on both sides, shape (..., 1)."""
    inner = np.minimum(np.maximum(value.argmin(axis=-1), 1), value.shape[-1] - 2)
    return np.asarray(inner)[..., None]


@cache
def _grid(points: int) -> Array:
    return np.linspace(0.0, 1.0, points)
