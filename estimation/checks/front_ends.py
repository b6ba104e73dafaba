"""Whether a front end of one's own keeps its protocol."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.validators import are_numbers, shown

from .rules import (
    RETURNED,
    Kept,
    attempt,
    problems_of,
    raise_problems,
    repeat_faults,
    require_array,
)
from .stream import CHANNELS, blocks, pushing, times

_CURE = "return the cleaned block, an array of the shape of wrench"
_METHODS = {
    "reset": (("rates",), "reset(self, rates)"),
    "update": (("wrench", "valid"), f"update(self, wrench, valid), to {_CURE}"),
}
_USUAL, _SLOWER = Rates(), Rates(sensor=60)
SLOW = 0.3
"""Frequency at which the delay is measured, Hz: somebody who leans in for a second or two."""
_HEARD = 30.0
"""Length of the signals that measure, s; the last 10 s of them count."""
_COUNTED = 10.0
_UNITY = 0.01
_AUDIBLE = 0.01
_BOUNDED = 10.0


def check_front_end(front_end: Any) -> None:
    """Check that an object keeps the protocol `FrontEnd`.

    It is given a made-up wrench with losses, a whole block among them. Checked are: signatures,
    shapes at two rates of the sensor, finite outputs within ten times the inputs, a stated
    ``delay`` of 0 s or more that a signal of 0.3 Hz shows to within a control step, a constant
    that comes out unchanged once the filter has settled (within 1 % after 20 s), unless the
    class says ``passes_constant = False``, as one that removes a bias does, repetition after a
    reset, and inputs, earlier outputs and the global random state left alone.

    Parameters
    ----------
    front_end : object
        An instance, or a class that can be built without arguments.

    Raises
    ------
    InputError
        If something is not right: all faults, each with its cure.
    """
    raise_problems(front_end, front_end_problems(front_end))


def front_end_problems(front_end: Any) -> list[str]:
    """Return every fault that `check_front_end` finds, each with its cure."""
    return problems_of(front_end, _METHODS, _faults)


def _faults(part: Any) -> Iterator[str]:
    found: dict[str, None] = {}
    given = pushing(_USUAL)
    first = _cleaned(part, _USUAL, given, found)
    yield from found
    if not np.isfinite(first).all():
        yield (
            "update returned numbers that are not finite, though all samples were: do you divide "
            "by the number of valid samples? A whole block may be lost"
        )
        return
    if np.abs(first).max() > _BOUNDED * np.abs(given).max():
        yield "its output grows beyond ten times its input: is it stable?"
        return
    _cleaned(part, _SLOWER, pushing(_SLOWER), found)
    again = _cleaned(part, _USUAL, given, found)
    yield from found
    yield from repeat_faults(
        first, [again], "two streams after equal resets", "set all state in reset"
    )
    if not found:
        yield from _signal_faults(part, found)


def _signal_faults(part: Any, found: dict[str, None]) -> Iterator[str]:
    """Yield what is wrong with what becomes of a constant and of a slow signal."""
    t = times(_USUAL, _HEARD)
    counted = t >= _HEARD - _COUNTED
    if getattr(part, "passes_constant", True):
        out = _cleaned(part, _USUAL, np.tile(CHANNELS, (len(t), 1)), found)[counted]
        worst = int(np.argmax((np.abs(out - CHANNELS) / np.abs(CHANNELS)).max(axis=0)))
        if np.abs(out - CHANNELS)[:, worst].max() > _UNITY * abs(CHANNELS[worst]):
            yield (
                f"a constant {CHANNELS[worst]:g} in channel {worst} comes out as "
                f"{out[-1, worst]:.3g} after {_HEARD:g} s: pass it on with gain 1, "
                "after 20 s at the latest, or say passes_constant = False in the class"
            )
    stated = attempt("delay fails after reset", getattr, part, "delay", None)
    if not are_numbers(stated) or not 0.0 <= float(stated) < np.inf:
        yield (
            f"delay is {shown(stated)} after reset: state by how many s a slow signal comes "
            "later, 0 or more"
        )
        return
    phase = 2.0 * np.pi * SLOW * t
    out = _cleaned(part, _USUAL, np.outer(np.sin(phase), CHANNELS), found)[counted]
    # Least squares over three whole turns: the part in step, and the part a quarter behind.
    turns = np.stack((np.sin(phase), -np.cos(phase)), axis=-1)[counted]
    ahead, behind = np.linalg.lstsq(turns, out / CHANNELS, rcond=None)[0]
    channel = int(np.argmin(np.hypot(ahead, behind)))
    if np.hypot(ahead, behind)[channel] < _AUDIBLE:
        yield f"a signal of {SLOW:g} Hz in channel {channel} does not come out: pass it on"
        return
    turn = 1.0 / SLOW
    later = np.arctan2(behind, ahead) / (2.0 * np.pi * SLOW)
    off = (later - float(stated) + turn / 2.0) % turn - turn / 2.0
    worst = int(np.argmax(np.abs(off)))
    if abs(off[worst]) > _USUAL.period:
        comes = round(float(stated) + off[worst], 4) + 0.0  # no -1e-17, and no -0
        yield (
            f"delay says {float(stated):.3g} s, a signal of {SLOW:g} Hz in channel {worst} comes "
            f"{comes:.3g} s later: state that"
        )


def _cleaned(part: Any, rates: Rates, wrench: Array, found: dict[str, None]) -> Array:
    """Return what comes out after a reset, shape (n, 6); note what is changed that must not."""
    kept, out = Kept(), []
    attempt("reset fails", part.reset, rates)
    at = f"with {rates.samples} samples a block"
    for step, (block, valid) in enumerate(blocks(wrench, rates)):
        kept.keep("update changes the wrench it is given: work on a copy", block)
        kept.keep("update changes valid: work on a copy", valid)
        cleaned = attempt(f"update fails at block {step} {at}", part.update, block, valid)
        require_array(f"update {at} returned", cleaned, block.shape, _CURE)
        if cleaned is not block:
            kept.keep(f"update {RETURNED}", cleaned)
        out.append(cleaned.astype(float))
    found |= dict.fromkeys(kept.faults())
    return np.concatenate(out)
