"""What a strategy's parts answered, looked at before it is used: the part itself is blamed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from cowalk.estimation.front_ends.protocol import FrontEnd
from cowalk.estimation.observers.protocol import Estimate, Observer
from cowalk.estimation.smoothers.protocol import Smoother
from cowalk.sim.basics.errors import PartError
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.validators import are_numbers, said

Shape = tuple[int, ...]


def require_block(front_end: FrontEnd, block: Any, shape: Shape) -> None:
    """Refuse what is no block of samples of that shape, all finite.

    Raises
    ------
    PartError
        With the front end to blame.
    """
    if not isinstance(block, np.ndarray) or not are_numbers(block, shape):
        what = f"the block of samples, cleaned, an array of real numbers of shape {shape}"
        raise PartError(front_end, f"update() gave {said(block)}; it must be {what}")
    if not np.isfinite(block).all():
        raise PartError(front_end, "update() gave samples that are not finite")


def require_estimate(observer: Observer, estimate: Any, shape: Shape) -> None:
    """Refuse what is no estimate: finite means, a stubbornness in [0, 1], the declared numbers.

    Raises
    ------
    PartError
        With the observer to blame.
    """
    if not isinstance(estimate, Estimate):
        raise PartError(observer, f"update() gave {said(estimate)}; it must be an Estimate")
    for name, finite in _PAIRS.items():
        value = getattr(estimate, name)
        allowed = (shape,) if finite else (shape, shape[-1:])
        right = any(are_numbers(value, each) for each in allowed)
        if not isinstance(value, np.ndarray) or not right:
            given = f"update() gave {name} = {said(value)}"
            what = f"an array of real numbers of shape {shape}"
            raise PartError(observer, f"{given}; it must be {what}")
        if finite and not np.isfinite(value).all():
            raise PartError(observer, f"update() gave {name} = {value}; it must be finite")
    share = estimate.stubbornness
    if (share < -_ROUNDING).any() or (share > 1.0 + _ROUNDING).any():
        raise PartError(observer, f"update() gave stubbornness = {share}; it must lie in [0, 1]")
    if not isinstance(estimate.extras, Mapping):
        given = f"update() gave extras {estimate.extras!r}"
        raise PartError(observer, f"{given}; they must be numbers by name")
    if not estimate.extras:
        return
    if undeclared := estimate.extras.keys() - getattr(observer, "columns", {}).keys():
        given = f"update() gave extras {sorted(undeclared)}"
        raise PartError(observer, f"{given} that its columns do not declare")
    for name, value in estimate.extras.items():
        if not are_numbers(value, shape[:-1]):
            given = f"update() gave extras with {name} = {said(value)}"
            raise PartError(observer, f"{given}; it must be a number")


def smoothed(smoother: Smoother, value: Array) -> Array:
    """Return what a smoother makes of a value, which it cannot change.

    Raises
    ------
    PartError
        If that is not finite, or of another shape; with the smoother to blame.
    """
    given = value.copy()
    result = smoother.update(given)
    if not are_numbers(result, value.shape):
        what = f"an array of shape {value.shape}" if value.shape else "a number"
        raise PartError(smoother, f"update() gave {said(result)}; it must be {what}")
    if not np.isfinite(result).all():
        raise PartError(smoother, f"update() gave {result}; it must be finite")
    return result


_ROUNDING = 1e-9
"""As far as rounding may lead out of [0, 1]."""
_PAIRS = {
    "stubbornness": True,
    "wish": True,
    "stubbornness_deviation": False,
    "wish_deviation": False,
}
"""Arrays of an estimate, and whether they must be finite: a deviation may be left open."""
