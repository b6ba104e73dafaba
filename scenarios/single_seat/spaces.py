"""What a learner perceives and does: scaled to about 1, bounded, and flat or not."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium.spaces import Box, Dict
from numpy.typing import NDArray

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.env.actions import pair_of
from cowalk.sim.env.perception import observation_space

from ..files.schema import Scenario

BEYOND = 5.0
"""Where observations are clipped, in their scales: far beyond all but what has gone wrong."""
LEVER = 1.0
"""At which `Scenario.force_limit` gives the scale of torques, m."""
ASIDE = 2.0
"""Scale of the offset from the path, m: about a corridor's width."""
SIGHT = 10.0
"""Scale of obstacles' places, m."""
SIZE = 1.0
"""Scale of obstacles' radii, m."""
PEDESTRIAN = 2.0
"""Scale of obstacles' speeds, m/s: a pedestrian in a hurry."""


def scales(scenario: Scenario) -> dict[str, Array]:
    """Return what each entry of an observation is divided by, by its name.

    Twists by the largest that the bounds allow, forces by ``force_limit``, stations by the
    length of the path, places in the world by the coordinate of the path that is largest,
    angles by half a turn, the time by ``duration``; what depends on nothing is a constant of
    this module. All are broadcast against the entry.
    """
    bounds, path, force = scenario.bounds, scenario.world.path, scenario.force_limit
    farthest = max(1.0, *(abs(x) for point in path.points for x in point))
    return {
        "twist": np.maximum(np.abs(bounds.lower), np.abs(bounds.upper)),
        "force": np.array(force),
        "wrench": np.repeat((force, force * LEVER), 3),
        "force_valid": np.array(1.0),
        "pose": np.array((path.length, ASIDE, math.pi)),
        "pose_world": np.array((farthest, farthest, math.pi)),
        "obstacles": np.array((1.0, SIGHT, SIGHT, SIZE, PEDESTRIAN, PEDESTRIAN)),
        "time": np.array(scenario.duration),
    }


class LearnerObservation:
    """Observations as a learner gets them.

    Parameters
    ----------
    scenario : Scenario
    form : {"flat", "dict"}
        One vector, or a dict of arrays by name.
    normalise : bool
        In scales, float32; else in SI units, float64.

    Raises
    ------
    InputError
        If there is no such form.
    """

    def __init__(self, scenario: Scenario, form: str, normalise: bool) -> None:
        if not isinstance(form, str) or form not in ("flat", "dict"):
            raise InputError(f"observation = {form!r}: must be one of flat, dict", ("observation",))
        self._flat = form == "flat"
        self._type: Any = np.float32 if normalise else np.float64
        given = observation_space(scenario.rates.samples)
        full = {
            name: np.broadcast_to(scale, given[name].shape or ()).astype(float)
            for name, scale in scales(scenario).items()
        }
        self._limits = {
            name: np.full_like(scale, BEYOND) if normalise else BEYOND * scale
            for name, scale in full.items()
        }
        self._factors = {
            name: 1.0 / scale if normalise else np.ones_like(scale) for name, scale in full.items()
        }
        self.layout: dict[str, slice] = {}
        """Where each entry stands in a flat observation."""
        at = 0
        for name, scale in full.items():
            self.layout[name] = slice(at, at + scale.size)
            at += scale.size
        self.space: Box | Dict
        if self._flat:
            limits = np.concatenate([limit.ravel() for limit in self._limits.values()])
            self.space = self._box(limits)
            self._flat_limits = limits
            self._flat_factors = np.concatenate([each.ravel() for each in self._factors.values()])
        else:
            self.space = Dict({name: self._box(limit) for name, limit in self._limits.items()})

    def _box(self, limit: Array) -> Box:
        return Box((-limit).astype(self._type), limit.astype(self._type), dtype=self._type)

    def __call__(self, observation: Observation) -> Any:
        """Return an observation of a seat in the learner's form: fresh arrays."""
        entries: Mapping[str, Array] = observation  # type: ignore[assignment]
        if not self._flat:
            return {
                name: self._scaled(entries[name], self._factors[name], limit)
                for name, limit in self._limits.items()
            }
        whole = np.concatenate([entries[name].ravel() for name in self.layout])
        return self._scaled(whole, self._flat_factors, self._flat_limits)

    def _scaled(self, value: Array, factor: Array, limit: Array) -> NDArray[Any]:
        scaled: NDArray[Any] = np.clip(value * factor, -limit, limit).astype(self._type)
        return scaled


class LearnerAction:
    """Actions as a learner gives them.

    Parameters
    ----------
    bounds : Box
        Of the seat's action in the PettingZoo environment, N or m/s and rad/s.
    normalise : bool
        -1 to 1 from one bound to the other, float32; else the action itself.
    """

    def __init__(self, bounds: Box, normalise: bool) -> None:
        self._normalise = normalise
        self._low: Array = bounds.low.astype(float)
        self._half: Array = (bounds.high.astype(float) - self._low) / 2.0
        self.space = Box(-1.0, 1.0, bounds.shape, np.float32) if normalise else bounds

    def __call__(self, action: Any) -> Any:
        """Return an action in the seat's own units; what is none as it is."""
        given = pair_of(action)
        if given is None or not self._normalise:
            return action  # the environment judges it
        return self._low + (given.astype(float) + 1.0) * self._half
