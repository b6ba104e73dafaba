"""What the methods of an agent, one act and one report must keep."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from cowalk.estimation.checks.rules import Broken, extra_faults, require_array
from cowalk.estimation.checks.stream import BOUNDS
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.validators import shown

from ..basics.protocols import Belief, Truth

FORCE_PLAUSIBLE = 100.0
"""Largest force of one hand that is plausible, N; people communicate with up to 30 N."""
FORCE_FAINT = 0.05
"""Largest force that somebody who insists cannot mean, N; the just noticeable one is larger."""
INSISTS = 0.1
"""Share of a disagreement insisted on, m/s or rad/s, at which a force is to be felt."""
LIE = 2.0
"""Factor by which a force may differ from what the truth stands for: noise and limits are less."""
_CURE = "return np.array([a, b]), one number for v, one for omega"
_LOWER, _UPPER = (np.asarray(end, dtype=float) for end in (BOUNDS.lower, BOUNDS.upper))
_SCALARS = ("utility_loss", "target_utility", "interaction", "interaction_smoothed")
_DEVIATIONS = ("stubbornness_deviation", "human_wish_deviation")
_PAIRS = ("stubbornness", "stubbornness_smoothed", "human_wish", "wish", *_DEVIATIONS)
_WITHIN = {
    "stubbornness": (0.0, 1.0),
    "stubbornness_smoothed": (0.0, 1.0),
    "utility_loss": (0.0, 1.0),
    "target_utility": (0.0, 1.0),
    "interaction": (-2.0, 2.0),
    "interaction_smoothed": (-2.0, 2.0),
}


def access_hint(error: Exception) -> str:
    """Return how an observation is read, if an error comes from reading it otherwise."""
    keys = ", ".join(Observation.__annotations__)
    if isinstance(error, AttributeError) and isinstance(error.obj, dict):
        key = error.name if error.name in Observation.__annotations__ else "twist"
        return f'; an observation is a dict: observation["{key}"], of the keys {keys}'
    return f"; an observation has the keys {keys}" if isinstance(error, KeyError) else ""


def require_pair(what: str, value: Any, cure: str) -> None:
    """Raise `Broken` unless a value is an array of two numbers (see `require_array`)."""
    require_array(what, value, (2,), cure)


def force_faults(force: Array) -> Iterator[str]:
    """Yield what is wrong with a hand force, N."""
    if not np.isfinite(force).all():
        yield "act returned a force that is not finite: every one must be; divided by 0?"
    elif np.abs(force).max() > FORCE_PLAUSIBLE:
        yield (
            f"act returned more than {FORCE_PLAUSIBLE:g} N, no hand pushes like that: return N, "
            "and bound the force"
        )


def insisted(truth: Truth, twist: Array) -> float:
    """Return how much of its disagreement with a twist a truth insists on, m/s or rad/s."""
    return float(np.nan_to_num(truth.stubbornness * np.abs(truth.wish - twist)).max())


def stated(truth: Truth, twist: Array) -> Array:
    """Return the force that a truth stands for by the common definition, N, shape (2,).

    NaN where it says too little, or its force says only a bound of s: at full stubbornness, in
    saturation.
    """
    share = truth.gain * truth.stubbornness * (truth.wish - twist) / BOUNDS.upper
    readable = (truth.stubbornness < 1.0) & (np.abs(share) < 1.0)
    return np.where(readable, truth.strength * share, np.nan)


def law_faults(forces: Array, stated: Array, delay: float) -> Iterator[str]:
    """Yield whether the forces of a walk are not those that its truths stand for.

    Parameters
    ----------
    forces, stated : ndarray, shape (steps, 2)
        N; see `stated`.
    delay : float
        That the truths state, control steps.
    """
    late = min(round(delay), len(forces))
    given, meant = forces[late:], stated[: len(stated) - late]
    for i, (direction, dimension) in enumerate((("forward", "v"), ("sideways", "omega"))):
        known = np.isfinite(meant[:, i])
        size = float(np.square(meant[known, i]).sum())
        if size < FORCE_FAINT**2 * max(1, int(known.sum())):
            continue
        share = float(given[known, i] @ meant[known, i]) / size
        if not 1.0 / LIE < share < LIE:
            yield (
                f"act pushes {direction} with {share:.2g} times what truth() stands for, "
                f"strength * gain * stubbornness * (wish - twist)/upper in {dimension}: say the "
                "stubbornness behind the force, or leave strength and gain unknown"
            )


def faint_faults(forces: Array, insisted: float) -> Iterator[str]:
    """Yield whether the forces of a walk, N, are too faint for what the truth insisted on."""
    peak = np.abs(forces).max()
    if 0.0 < peak < FORCE_FAINT and insisted > INSISTS:
        yield (
            f"act returned at most {peak:.2g} N, too faint to be felt, while truth() insists on "
            f"{insisted:.2g} m/s or rad/s: return N; is it in kN?"
        )


def truth_faults(truth: Any) -> Iterator[str]:
    """Yield what is wrong with a `Truth`."""
    if not isinstance(truth, Truth):
        cure = "return Truth(wish=np.array([v, omega]), stubbornness=np.array([s_v, s_omega]))"
        raise Broken(f"truth returned {shown(truth)}: {cure}")
    for name in ("wish", "stubbornness", "strength", "limit"):
        require_pair(f"truth().{name} is", getattr(truth, name), _CURE)
    for name in ("gain", "delay"):
        value = np.asarray(getattr(truth, name))
        if value.ndim or value.dtype.kind not in "fiu":
            raise Broken(f"truth().{name} is {shown(getattr(truth, name))}: return one number")
    if not truth.delay >= 0.0:
        yield "truth().delay is not 0 s or more: give the reaction time in s"
    for name in ("strength", "gain", "limit"):
        if (np.asarray(getattr(truth, name)) < 0.0).any():
            yield f"truth().{name} is below 0: give what the person has, or leave it out"
    if ((truth.stubbornness < 0.0) | (truth.stubbornness > 1.0)).any():
        yield (
            "truth().stubbornness leaves [0, 1]: it is the share of the disagreement that the "
            "human insists on; clip what goes beyond"
        )
    if ((truth.wish < _LOWER - 1e-9) | (truth.wish > _UPPER + 1e-9)).any():
        yield (
            f"truth().wish leaves the situation's bounds, here {_LOWER.tolist()} to "
            f"{_UPPER.tolist()} m/s and rad/s: what is asked for beyond is insistence; clip it to "
            "situation.bounds.lower and .upper"
        )


def twist_faults(twist: Array) -> Iterator[str]:
    """Yield what is wrong with a twist, m/s and rad/s."""
    if not np.isfinite(twist).all():
        yield "act returned a twist that is not finite: every one must be"
    elif (twist < _LOWER - 1e-9).any() or (twist > _UPPER + 1e-9).any():
        yield "act leaves the situation's bounds: clip to situation.bounds.lower and .upper"


def belief_faults(belief: Any, columns: Mapping[str, str]) -> Iterator[str]:
    """Yield what is wrong with a `Belief`, extras by the ``columns`` that are declared."""
    if not isinstance(belief, Belief):
        cure = "return Belief(), NaN where there is no opinion"
        raise Broken(f"belief returned {shown(belief)}: {cure}")
    for name in _PAIRS:
        require_pair(f"belief().{name} is", getattr(belief, name), _CURE)
    for name in (*_SCALARS, "negotiation"):
        value = np.asarray(getattr(belief, name))
        if value.ndim or value.dtype.kind not in "fiu":
            cure = "return one number" + ("" if name == "negotiation" else ", NaN for no opinion")
            raise Broken(f"belief().{name} is {shown(getattr(belief, name))}: {cure}")
    for name, (low, high) in _WITHIN.items():
        value = np.asarray(getattr(belief, name))
        if ((value < low - 1e-9) | (value > high + 1e-9)).any():
            yield f"belief().{name} leaves [{low:g}, {high:g}]: clip it, or leave it NaN"
    for name in _DEVIATIONS:
        if (getattr(belief, name) < 0.0).any():
            yield f"belief().{name} is below 0: give a standard deviation, or leave it NaN"
    yield from extra_faults("belief().extras", belief.extras, columns)
