"""Whether an observer of one's own keeps its protocol."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.validators import shown

from ..observers.protocol import Estimate
from .rules import (
    RETURNED,
    Broken,
    Kept,
    attempt,
    column_faults,
    extra_faults,
    generator_faults,
    problems_of,
    raise_problems,
    repeat_faults,
    require_array,
)
from .stream import BOUNDS, reading, samples, situation

_PAIRS = ("stubbornness", "wish", "stubbornness_deviation", "wish_deviation")
"""Arrays of an estimate, in the order in which `_heard` lists them."""
_PAIR = "return np.array([a, b]), one number for v, one for omega"
_CURE = "return Estimate(stubbornness=np.array([s_v, s_omega]), wish=np.array([v, omega]))"
_METHODS = {
    "reset": (("situation", "reading", "rng"), "reset(self, situation, reading, rng)"),
    "update": (("sample", "own_wish"), "update(self, sample, own_wish), to return an Estimate"),
}
_USUAL, _SLOWER = Rates(), Rates(sensor=60)
_ANSWERS = 1e-3
"""Least difference of a stubbornness, or of a wish in m/s or rad/s, that counts as an answer."""
_SLACK = 1e-9


def check_observer(observer: Any) -> None:
    """Check that an object keeps the protocol `Observer`.

    It hears a made-up walk of 8 s that sets off from rest, turns, halts, and loses samples, a
    whole control step among them. Checked are: signatures, shapes at two rates of the sensor, a
    finite stubbornness within [0, 1] and a finite wish within the bounds from the first step on,
    deviations of 0 or more, or NaN, extras that are the declared ``columns``, a posterior that
    answers, repetition after a reset with an equal generator, another start of the generators it
    keeps after a reset with another one, what it is given, earlier estimates and the global
    random state left alone, and an estimate that answers the force, unless the class says
    ``reads_force = False``. An estimate may be held between negotiations.

    Parameters
    ----------
    observer : object
        An instance, or a class that can be built without arguments.

    Raises
    ------
    InputError
        If something is not right: all faults, each with its cure.
    """
    raise_problems(observer, observer_problems(observer))


def observer_problems(observer: Any) -> list[str]:
    """Return every fault that `check_observer` finds, each with its cure."""
    return problems_of(observer, _METHODS, _faults)


def _faults(part: Any) -> Iterator[str]:
    found = dict.fromkeys(column_faults(getattr(part, "columns", {})))
    yield from found
    first = _heard(part, _USUAL, 1.0, found)
    yield from found
    again = _heard(part, _USUAL, 1.0, found)
    fainter = _heard(part, _USUAL, 0.3, found)
    _heard(part, _SLOWER, 1.0, found)
    last = _heard(part, _USUAL, 1.0, found)
    yield from found

    def reset(seed: int) -> None:
        part.reset(situation(_USUAL), reading(), np.random.default_rng(seed))

    yield from generator_faults(part, reset, "the same numbers")
    cure = "set all state in reset, and draw only from the rng that reset is given"
    yield from repeat_faults(
        first, [again, last], "two walks after resets with equal generators", cure
    )
    if not found:
        yield from _answer_faults(part, float(np.abs(first - fainter)[:, :4].max()))


def _answer_faults(part: Any, difference: float) -> Iterator[str]:
    says = getattr(part, "reads_force", True)
    if says and difference < _ANSWERS:
        yield (
            "its estimate is the same however hard the human pushes: use sample.wrench, or say "
            "reads_force = False in the class"
        )
    elif not says and difference > 0.0:
        yield "it says reads_force = False, yet its estimate answers the force: leave that out"


def _heard(part: Any, rates: Rates, push: float, found: dict[str, None]) -> Array:
    """Return the estimates of a walk, shape (steps, 8); note every fault."""
    kept, out = Kept(), []
    columns = getattr(part, "columns", {})
    rng = np.random.default_rng(7)
    attempt("reset fails", part.reset, situation(rates), reading(), rng)
    at = f"with {rates.samples} samples a step"
    for step, (sample, own_wish) in enumerate(samples(rates, push)):
        for name in ("wrench", "valid", "twist", "pose"):
            given = getattr(sample, name)
            kept.keep(f"update changes sample.{name}: work on a copy", given)
        kept.keep("update changes own_wish: work on a copy", own_wish)
        estimate = attempt(f"update fails at step {step} {at}", part.update, sample, own_wish)
        found |= dict.fromkeys(_estimate_faults(estimate, columns))
        for name in _PAIRS:
            value = getattr(estimate, name)
            if value is not own_wish:
                kept.keep(f"update {RETURNED}", value)
        out.append(np.concatenate([getattr(estimate, name) for name in _PAIRS], dtype=float))
    if estimate.posterior is not None:
        _require_posterior(estimate.posterior)
    found |= dict.fromkeys(kept.faults())
    return np.array(out)


def _estimate_faults(estimate: Any, columns: Mapping[str, str]) -> Iterator[str]:
    """Yield what is wrong with an estimate."""
    if not isinstance(estimate, Estimate):
        raise Broken(f"update returned {shown(estimate)}: {_CURE}")
    for name in _PAIRS:
        require_array(f"Estimate.{name} is", getattr(estimate, name), (2,), _PAIR)
    share, wish = estimate.stubbornness, estimate.wish
    for name, value in (("stubbornness", share), ("wish", wish)):
        if not np.isfinite(value).all():
            yield f"Estimate.{name} is not finite: give the best there is from the first step on"
    if ((share < -_SLACK) | (share > 1.0 + _SLACK)).any():
        yield "Estimate.stubbornness leaves [0, 1]: clip what goes beyond"
    if ((wish < np.array(BOUNDS.lower) - _SLACK) | (wish > np.array(BOUNDS.upper) + _SLACK)).any():
        yield (
            "Estimate.wish leaves the situation's bounds: clip to situation.bounds.lower and .upper"
        )
    for name in ("stubbornness_deviation", "wish_deviation"):
        value = getattr(estimate, name)
        if (value < 0.0).any() or np.isinf(value).any():
            yield f"Estimate.{name} is negative or infinite: give a standard deviation, or NaN"
    yield from extra_faults("Estimate.extras", estimate.extras, columns)
    for name in columns:
        if name not in estimate.extras:
            yield f"columns declares {name!r}, Estimate.extras lacks it: give a number, or NaN"


def _require_posterior(posterior: Any) -> None:
    """Raise `Broken` unless a posterior answers as `Posterior` says."""
    rng = np.random.default_rng(5)
    for name, arguments, shape in (
        ("quantile", (0.5,), (2,)),
        ("sample", (rng, 3), (3, 2)),
    ):
        if not callable(getattr(posterior, name, None)):
            raise Broken(
                f"Estimate.posterior has no method {name!r}: see Posterior, or leave it out"
            )
        pair = attempt(f"posterior.{name} fails", getattr(posterior, name), *arguments)
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise Broken(f"posterior.{name} returned {shown(pair)}: return stubbornness and wish")
        for value in pair:
            cure = f"return two arrays of shape {shape}, stubbornness and wish"
            require_array(f"posterior.{name} returned", value, shape, cure)
    if not callable(getattr(posterior, "wish_at", None)):
        raise Broken("Estimate.posterior has no method 'wish_at': see Posterior, or leave it out")
    wish = attempt("posterior.wish_at fails", posterior.wish_at, np.zeros(3))
    require_array("posterior.wish_at returned", wish, (2,), _PAIR)
