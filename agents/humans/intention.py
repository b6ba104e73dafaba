"""Where a human wants to go: a preferred pace, and a way around what they see."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.agents.interfaces import Observation, Situation
from cowalk.sim.motion import Array


@dataclass(frozen=True)
class IntentionSettings:
    """What a human wants from the walk, shared by every model.

    Parameters
    ----------
    pace : float or None
        Preferred speed in m/s; None is the scenario's pace.
    margin : float
        Distance in m that the human wants between obstacles and both bodies.
    anticipation : float
        Distance in m ahead at which they begin to walk around what they see.
    lookahead : float
        Distance in m ahead of the base at which they aim.
    extent : (float, float)
        How far base and human together reach to the left and to the right of the base's
        centre, m. Inferred from the plants' body sizes.
    """

    pace: float | None = None
    margin: float = 0.15
    anticipation: float = 4.0
    lookahead: float = 1.6
    extent: tuple[float, float] = (0.28, 0.87)


class Intention:
    """The twist that a human would have, from where they are and what they see.

    They follow the path, walk around the nearest obstacle they see on the side that asks for
    the smaller detour, and steer as a pure pursuit: omega = 2 v sin(alpha) / lookahead, alpha
    the bearing of the aim.

    Parameters
    ----------
    settings : IntentionSettings
    situation : Situation
    """

    def __init__(self, settings: IntentionSettings, situation: Situation) -> None:
        self._settings = settings
        self._pace = situation.pace if settings.pace is None else settings.pace
        self._lower = np.asarray(situation.bounds.lower, dtype=float)
        self._upper = np.asarray(situation.bounds.upper, dtype=float)

    def wish(self, observation: Observation) -> Array:
        """Return the wanted twist, m/s and rad/s, shape (..., 2)."""
        pose, obstacles = observation["pose"], observation["obstacles"]
        offset, heading = pose[..., 1], pose[..., 2]
        aim = self._lateral_aim(offset, heading, obstacles) if obstacles.any() else 0.0
        bearing = np.arctan2(aim - offset, self._settings.lookahead) - heading
        omega = 2.0 * self._pace * np.sin(bearing) / self._settings.lookahead
        wanted = np.empty((*offset.shape, 2))
        wanted[..., 0] = self._pace
        wanted[..., 1] = omega
        return np.clip(wanted, self._lower, self._upper)

    def _lateral_aim(self, offset: Array, heading: Array, obstacles: Array) -> Array:
        """Return the lateral offset from the path that clears the nearest obstacle, m."""
        settings = self._settings
        present, x, y, radius = np.moveaxis(obstacles[..., :4], -1, 0)
        cos, sin = np.cos(heading)[..., None], np.sin(heading)[..., None]
        along = cos * x - sin * y
        across = offset[..., None] + sin * x + cos * y
        ahead = (present > 0.0) & (along > -radius - max(settings.extent))
        ahead &= along < settings.anticipation + radius
        pass_left = across + radius + settings.margin + settings.extent[1]
        pass_right = across - radius - settings.margin - settings.extent[0]
        detour = np.where(np.abs(pass_left) <= np.abs(pass_right), pass_left, pass_right)
        in_the_way = ahead & (pass_left > 0.0) & (pass_right < 0.0)
        nearest = np.argmin(np.where(in_the_way, along, np.inf), axis=-1)[..., None]
        chosen = np.take_along_axis(np.where(in_the_way, detour, 0.0), nearest, axis=-1)
        return np.asarray(chosen[..., 0])
