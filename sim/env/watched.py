"""What those who watch an environment may see of it, and no seat: truth, readings, pictures."""

from __future__ import annotations

import numpy as np

from ..basics.motion import Array
from ..plant.protocol import Plant, PlantState
from ..sensor.sensor import Reading
from .resumable import ResumableEnv
from .reward import Reward, Terms


class WatchedEnv(ResumableEnv):
    """An environment whose plant, sensor and rewards can be looked at after every step."""

    _state: PlantState
    _reading: Reading
    _reward: Reward
    _terms: Terms
    _window_needed: bool

    @property
    def plant(self) -> Plant:
        """The plant: truth, for those who watch, not for the seats."""
        return self._plant

    @property
    def plant_state(self) -> PlantState:
        """State of the plant after the last step or reset: truth, not for the seats."""
        self._require("plant_state")
        return self._state

    @property
    def measured_force(self) -> Array:
        """Planar force that the sensor read in the last step, N, base axes, shape (samples, 2)."""
        self._require("measured_force")
        return self._reading.force

    @property
    def sensor_reading(self) -> Reading:
        """All that it read, in its own axes too, with flags for what was lost or out of range."""
        self._require("sensor_reading")
        return self._reading

    @property
    def reward_terms(self) -> dict[str, dict[str, float]]:
        """What each term added to each seat's reward in the last step; zeros after a reset.

        They sum up to the reward but for rounding.
        """
        self._require("reward_terms")
        return self._reward.by_name(self._terms)

    def render(self) -> np.ndarray | None:
        """Return a picture, uint8, shape (480, 640, 3), or show it in mode ``"human"``.

        Raises
        ------
        SimulationError
            If there was no `reset` yet, or the environment is closed.
        """
        self._require("render", opened=True)
        if self.render_mode == "rgb_array":
            return self._plant.render(640, 480)
        if self._window_needed:
            from ..view.window import show

            show(self._plant.render(640, 480))
        return None
