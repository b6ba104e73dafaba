"""Whether a smoother of one's own keeps its protocol."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.validators import are_numbers, shown

from .rules import (
    RETURNED,
    Broken,
    Kept,
    attempt,
    problems_of,
    raise_problems,
    repeat_faults,
    require_array,
)

_CURE = "return the smoothed value, of the shape of what update is given"
_METHODS = {
    "reset": (("initial",), "reset(self, initial)"),
    "update": (("value",), f"update(self, value), to {_CURE}"),
}
_SHAPES: tuple[tuple[int, ...], ...] = ((), (2,))
_SETTLED = 200
"""Negotiations after which a smoother must have followed a step: more than two minutes."""
_NEAR = 0.05
"""How near to the height of a step it must be then, of that height."""
_CONSTANT = 1e-6
_BOUNDED = 10.0


def check_smoother(smoother: Any) -> None:
    """Check that an object keeps the protocol `Smoother`.

    It is given values one by one, scalars and pairs. Checked are: signatures, shapes, finite
    outputs within ten times the inputs, a constant that stays as it is after a reset with it, a
    step that is followed within 200 values, repetition after a reset, inputs, earlier outputs
    and the global random state left alone, and copies that share nothing: an automation smooths
    what it logs with a copy.

    Parameters
    ----------
    smoother : object
        An instance, or a class that can be built without arguments.

    Raises
    ------
    InputError
        If something is not right: all faults, each with its cure.
    """
    raise_problems(smoother, smoother_problems(smoother))


def smoother_problems(smoother: Any) -> list[str]:
    """Return every fault that `check_smoother` finds, each with its cure."""
    return problems_of(smoother, _METHODS, _faults)


def _faults(part: Any) -> Iterator[str]:
    found: dict[str, None] = {}
    for shape in _SHAPES:
        _examine(part, shape, found)
        yield from found
    if not found:  # what comes of a copy is of no use where already this is wrong
        yield from _copy_faults(part)


def _examine(part: Any, shape: tuple[int, ...], found: dict[str, None]) -> None:
    rng = np.random.default_rng(3)
    values = list(rng.uniform(-1.0, 1.0, (60, *shape)) + np.ones(shape))
    zero, one = np.zeros(shape), np.ones(shape)
    first = _smoothed(part, zero, values, found)
    if not np.isfinite(first).all():
        found["update returned numbers that are not finite, though all values were"] = None
        return
    if np.abs(first).max() > _BOUNDED * np.abs(values).max():
        found["its output grows beyond ten times its input: is it stable?"] = None
    constant = _smoothed(part, 0.7 * one, [0.7 * one] * 30, found)
    if np.abs(constant - 0.7).max() > _CONSTANT:
        found[
            "after reset(0.7), values of 0.7 come out as others: behave as if the initial value "
            "had been seen for ever, and weigh all values by 1 in total"
        ] = None
    step = _smoothed(part, zero, [one] * _SETTLED, found)
    if np.abs(step[-1] - 1.0).max() > _NEAR:
        found[
            f"{_SETTLED} values of 1 after a reset to 0 bring it to {step[-1].flat[0]:.3g}: it "
            "must follow a value that stays, and sooner than a run is over"
        ] = None
    again = _smoothed(part, zero, values, found)
    what = "two streams after equal resets"
    flat = [run.reshape(len(values), -1) for run in (first, again)]
    found |= dict.fromkeys(repeat_faults(flat[0], flat[1:], what, "set all state in reset"))


def _smoothed(part: Any, initial: Array, values: list[Array], found: dict[str, None]) -> Array:
    """Return what comes out after a reset, shape (n, ...); note what is changed that must not."""
    kept, out = Kept(), []
    kept.keep("reset changes the initial value: work on a copy", initial)
    attempt("reset fails", part.reset, initial)
    for step, value in enumerate(values):
        given = np.array(value)
        kept.keep("update changes the value it is given: work on a copy", given)
        smoothed = attempt(
            f"update fails at value {step} of shape {given.shape}", part.update, given
        )
        if given.ndim:
            require_array("update returned", smoothed, given.shape, _CURE)
        elif not are_numbers(smoothed):
            raise Broken(f"update returned {shown(smoothed)} for one number: {_CURE}")
        if isinstance(smoothed, np.ndarray) and smoothed is not given:
            kept.keep(f"update {RETURNED}", smoothed)
        out.append(np.array(smoothed, dtype=float))
    found |= dict.fromkeys(kept.faults())
    return np.array(out)


def _copy_faults(part: Any) -> Iterator[str]:
    """Yield whether a copy of a smoother moves the smoother itself."""
    twin = attempt("copy.deepcopy of it fails", copy.deepcopy, part)
    values = np.random.default_rng(4).uniform(size=20)
    outputs = []
    for disturbed in (False, True):
        attempt("reset fails", part.reset, np.zeros(()))
        attempt("reset of a copy fails", twin.reset, np.zeros(()))
        heard = []
        for value in values:
            heard.append(float(attempt("update fails", part.update, np.asarray(value))))
            if disturbed:
                attempt("update of a copy fails", twin.update, np.asarray(5.0))
        outputs.append(heard)
    if outputs[0] != outputs[1]:
        yield "a copy of it changes it: keep state in the object, set in reset, not in the class"
