"""What one act and one report of an agent must keep, and the made-up walk that tests it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from cowalk.sim.motion import Array, TwistBounds
from cowalk.sim.observation import OBSTACLE_COLUMNS, OBSTACLE_ROWS
from cowalk.sim.path import Path

from .interfaces import Belief, Observation, Situation, Truth

FORCE_PLAUSIBLE = 100.0
"""Largest force of one hand that is plausible, N; people communicate with up to 30 N."""
TWIST_PLAUSIBLE = (3.0, 3.5)
"""Largest wish that is plausible beside a walking human, m/s and rad/s."""

SITUATION = Situation(
    Path(((0.0, 0.0), (30.0, 0.0))), 0.8, TwistBounds((0.0, -0.5), (1.2, 0.5)), 0.05
)
STEPS = 160
_CURE = "return np.array([a, b]), one number for v, one for omega"
_SCALARS = ("utility_loss", "target_utility", "interaction", "interaction_smoothed")


class Broken(Exception):
    """A fault after which the walk cannot go on."""


def observations(motion: float, push: float) -> Iterator[Observation]:
    """Yield a made-up walk past a puddle.

    Parameters
    ----------
    motion : float
        Scales how far the base's twist swings about a steady walk, 1.
    push : float
        Scales the measured force, 1.
    """
    pose = np.array([0.0, 0.2, 0.0])
    for step in range(STEPS):
        time = step * SITUATION.period
        v, omega = 0.7 + 0.2 * motion * np.sin(2.0 * time), 0.25 * motion * np.cos(1.4 * time)
        pose = pose + SITUATION.period * np.array([v, v * np.sin(pose[2]), omega])
        puddle = np.zeros((OBSTACLE_ROWS, OBSTACLE_COLUMNS))
        puddle[0, :4] = (1.0, 4.0 - pose[0], -0.6 - pose[1], 0.3)
        force = push * np.array([1.5 * np.sin(time), 3.0 * np.cos(0.9 * time)])
        wrist = 0.2 * push * np.sin(0.7 * time)
        yield Observation(
            twist=np.array([v, omega]),
            force=np.tile(force, (12, 1)),
            wrench=np.tile((*force, 0.0, 0.0, 0.0, wrist), (12, 1)),
            force_valid=np.ones(12),
            pose=pose.copy(),
            pose_world=pose.copy(),  # the path is the world's x axis
            obstacles=puddle,
            time=np.array([time]),
        )


def require_pair(what: str, value: Any, cure: str) -> None:
    """Raise `Broken` unless a value is an array of two numbers.

    Parameters
    ----------
    what : str
        What was returned where, for the message.
    value : object
    cure : str
        What to return instead.
    """
    if not isinstance(value, np.ndarray):
        raise Broken(f"{what} {_brief(value)}, no NumPy array: {cure}")
    if value.shape != (2,):
        raise Broken(f"{what} an array of shape {value.shape}: {cure}")
    if value.dtype.kind not in "fiu":
        raise Broken(f"{what} an array of {value.dtype} instead of numbers: {cure}")


def _brief(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


def force_faults(force: Array) -> Iterator[str]:
    """Yield what is wrong with a hand force, N."""
    if not np.isfinite(force).all():
        yield f"act returned {force}: every force must be finite; do you divide by a speed of 0?"
    elif np.abs(force).max() > FORCE_PLAUSIBLE:
        yield (
            f"act returned more than {FORCE_PLAUSIBLE:g} N, no hand pushes like that: return N, "
            "and bound the force"
        )


def truth_faults(truth: Any) -> Iterator[str]:
    """Yield what is wrong with a `Truth`."""
    if not isinstance(truth, Truth):
        cure = "return Truth(wish=np.array([v, omega]), stubbornness=np.array([s_v, s_omega]))"
        raise Broken(f"truth returned {_brief(truth)}: {cure}")
    for name in ("wish", "stubbornness"):
        value = getattr(truth, name)
        require_pair(f"truth().{name} is", value, _CURE)
        if not np.isfinite(value).all():
            yield f"truth().{name} is not finite: report what the model wants at every step"
    if ((truth.stubbornness < 0.0) | (truth.stubbornness > 1.0)).any():
        yield (
            "truth().stubbornness leaves [0, 1]: it is the share of the disagreement that the "
            "human insists on; clip what goes beyond"
        )
    if (np.abs(truth.wish) > TWIST_PLAUSIBLE).any():
        yield "truth().wish is faster than anybody walks: return m/s and rad/s"


def twist_faults(twist: Array) -> Iterator[str]:
    """Yield what is wrong with a twist, m/s and rad/s."""
    lower, upper = (np.asarray(end) for end in (SITUATION.bounds.lower, SITUATION.bounds.upper))
    if not np.isfinite(twist).all():
        yield f"act returned {twist}: every twist must be finite"
    elif (twist < lower - 1e-9).any() or (twist > upper + 1e-9).any():
        yield "act leaves the situation's bounds: clip to situation.bounds.lower and .upper"


def belief_faults(belief: Any) -> Iterator[str]:
    """Yield what is wrong with a `Belief`."""
    if not isinstance(belief, Belief):
        cure = "return Belief(), NaN where there is no opinion"
        raise Broken(f"belief returned {_brief(belief)}: {cure}")
    for name in ("stubbornness", "stubbornness_smoothed", "human_wish", "wish"):
        require_pair(f"belief().{name} is", getattr(belief, name), _CURE)
    for name in (*_SCALARS, "negotiation"):
        value = np.asarray(getattr(belief, name))
        if value.ndim or value.dtype.kind not in "fiu":
            cure = "return one number" + ("" if name == "negotiation" else ", NaN for no opinion")
            raise Broken(f"belief().{name} is {_brief(getattr(belief, name))}: {cure}")
    within = {"stubbornness": (0.0, 1.0), "stubbornness_smoothed": (0.0, 1.0)}
    within |= {"utility_loss": (0.0, 1.0), "target_utility": (0.0, 1.0)}
    within |= {"interaction": (-2.0, 2.0), "interaction_smoothed": (-2.0, 2.0)}
    for name, (low, high) in within.items():
        value = np.asarray(getattr(belief, name))
        if ((value < low - 1e-9) | (value > high + 1e-9)).any():
            yield f"belief().{name} leaves [{low:g}, {high:g}]: clip it, or leave it NaN"
