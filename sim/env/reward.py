"""What each seat is rewarded for, so that either can be learned against the other."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ..basics.parameters import parameters
from ..basics.seats import SEATS
from ..basics.validators import Range, require_ranges
from ..plant.protocol import PlantState

_WEIGHT: Range = (-1000.0, 1000.0, "")
_SCALES: dict[str, Range] = {
    "force_scale": (0.01, 1000.0, "N"),
    "offset_scale": (0.01, 100.0, "m"),
    "comfort": (0.01, 100.0, "m"),
}
"""From what no sensor resolves to what no pair reaches (inferred)."""


@dataclass(frozen=True)
class RewardWeights:
    """How much each term of `Reward` counts for a seat; by default, for the human.

    The first five are of a second of walking at the usual pace, the last two of the end.
    A weight of 0 leaves a term out; a negative one turns a cost into a gain.

    Raises
    ------
    InputError
        If one is no number, or beyond 1000 either way.
    """

    progress: float = 1.0
    offset: float = 0.0
    pace: float = 0.0
    effort: float = 1.0
    closeness: float = 2.0
    arrival: float = 1.0
    collision: float = 10.0

    def __post_init__(self) -> None:
        require_ranges(self, dict.fromkeys(TERMS, _WEIGHT))

    def of_each(self) -> tuple[float, ...]:
        """Return the weights in the order of `TERMS`."""
        return tuple(getattr(self, term) for term in TERMS)


@dataclass(frozen=True)
class AutomationWeights(RewardWeights):
    """`RewardWeights` whose defaults are those of the automation."""

    offset: float = 1.0
    pace: float = 1.0
    closeness: float = 0.0


TERMS = tuple(item.name for item in fields(RewardWeights))
"""Every term of the reward, in the order in which they are reported."""


@dataclass(frozen=True)
class RewardParameters:
    """What the seats are rewarded for; `Reward` has the equation.

    Attributes
    ----------
    human, automation : RewardWeights
        Weights of the terms for each seat; a mapping gives some of them.
    force_scale : float
        Mean interaction force F_0 that costs as much as standing still, N (inferred).
    offset_scale : float
        Lateral offset e_0 that does, m.
    comfort : float
        Clearance c_0 below which closeness begins to cost, m (inferred).

    Raises
    ------
    InputError
        If a weight is unknown, or a value makes no sense.
    """

    human: RewardWeights = RewardWeights()
    automation: AutomationWeights = AutomationWeights()
    force_scale: float = 7.5
    offset_scale: float = 1.0
    comfort: float = 0.3

    def __post_init__(self) -> None:
        for seat, kind in (("human", RewardWeights), ("automation", AutomationWeights)):
            object.__setattr__(self, seat, parameters(seat, kind, getattr(self, seat)))
        require_ranges(self, _SCALES)


Terms = tuple[float, ...]
"""The terms of a control step, not yet weighted, in the order of `TERMS`."""
NO_TERMS: Terms = (0.0,) * len(TERMS)


class Reward:
    """Rewards per control step, in units of "a second of walking at the usual pace".

    With dt the control period, v the base's speed and v_path its part along the path, e the
    lateral offset in m, F the mean interaction force of the step, c the clearance in m, and w
    the weights of a seat, its reward is

    dt (w_progress v_path/pace - w_offset e^2/e_0^2 - w_pace (v/pace - 1)^2
    - w_effort |F|^2/F_0^2 - w_closeness max(0, 1 - c/c_0))
    + w_arrival [arrived] - w_collision [collided].

    By default the human is to walk on with little effort and to keep away from what is in the
    way, the puddle included; the automation to get on, to keep to the path and the pace, and
    not to make the human push. The weights are inferred.

    Parameters
    ----------
    pace : float
        Usual walking speed, m/s.
    period : float
        Control period, s.
    given : RewardParameters
    """

    def __init__(
        self, pace: float, period: float, given: RewardParameters = RewardParameters()
    ) -> None:
        self._pace, self._period, self._given = pace, period, given
        self._weights = {seat: getattr(given, seat).of_each() for seat in SEATS}
        signed = (period, -period, -period, -period, -period, 1.0, -1.0)
        self._factors = {
            seat: tuple(sign * weight for sign, weight in zip(signed, weights, strict=True))
            for seat, weights in self._weights.items()
        }

    def terms(
        self,
        state: PlantState,
        relative_pose: tuple[float, float, float],
        clearance: float,
        collision: bool,
        goal: bool,
    ) -> Terms:
        """Return the terms of the control step that ended in ``state``, not yet weighted.

        Parameters
        ----------
        state : PlantState
        relative_pose : (station, offset, heading)
            Base pose relative to the path: m, m, rad.
        clearance : float
            Distance of the nearest body to anything, m.
        collision, goal : bool
            Whether the step ended the episode that way.
        """
        given = self._given
        _, offset, heading = relative_pose
        speed = state.twist[0]
        force = state.force_on_base
        # A third of the time that `mean` takes.
        fx, fy = np.add.reduce(force).tolist()
        return (
            speed * math.cos(heading) / self._pace,
            (offset / given.offset_scale) ** 2,
            (speed / self._pace - 1.0) ** 2,
            (fx * fx + fy * fy) / (len(force) * given.force_scale) ** 2,
            max(0.0, 1.0 - clearance / given.comfort),
            float(goal),
            float(collision),
        )

    def of_each_seat(self, terms: Terms) -> dict[str, float]:
        """Return the reward of each seat for a control step, from its terms."""
        progress, offset, pace, effort, closeness, arrival, collision = terms
        rewards = {}
        for seat, weights in self._weights.items():
            w_progress, w_offset, w_pace, w_effort, w_closeness, w_arrival, w_collision = weights
            walking = w_progress * progress - w_offset * offset - w_pace * pace
            walking = walking - w_effort * effort - w_closeness * closeness
            end = w_arrival * arrival - w_collision * collision
            rewards[seat] = self._period * walking + end
        return rewards

    def by_name(self, terms: Terms) -> dict[str, dict[str, float]]:
        """Return what each term adds to the reward of each seat; costs are negative."""
        return {
            seat: {
                name: factor * term + 0.0  # no -0.0
                for name, factor, term in zip(TERMS, factors, terms, strict=True)
            }
            for seat, factors in self._factors.items()
        }


def reward_parameters(given: Any) -> RewardParameters:
    """Return what was given as `RewardParameters`: them, a mapping of them, or None.

    Raises
    ------
    InputError
        If it is neither, a key is unknown or a value refused.
    """
    return parameters("reward", RewardParameters, given)
