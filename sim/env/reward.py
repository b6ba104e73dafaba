"""What each seat is rewarded for, so that either can be learned against the other."""

from __future__ import annotations

import math

import numpy as np

from ..plant.protocol import PlantState

FORCE_SCALE = 7.5
"""Mean force in N that costs as much as standing still."""
COMFORT = 0.3
"""Clearance in m below which closeness begins to cost."""
FAILURE = 10.0
"""Penalty of a collision."""
ARRIVAL = 1.0
"""Reward of reaching the end of the path."""


class Reward:
    """Rewards per control step, in units of "a second of walking at the usual pace".

    With dt the control period, v_path the speed along the path, e the lateral offset in m, F
    the mean interaction force of the step and c the clearance in m,

    - human: dt (v_path/pace - |F|^2/F_0^2 - 2 max(0, 1 - c/c_0)): walk on, with little effort,
      and keep away from what is in the way, the puddle included;
    - automation: dt (v_path/pace - e^2 - (v/pace - 1)^2 - |F|^2/F_0^2): get on, keep to the
      path and the pace, and do not make the human push;
    - both: -10 for a collision, +1 for arriving.

    Parameters
    ----------
    pace : float
        Usual walking speed, m/s.
    period : float
        Control period, s.
    """

    def __init__(self, pace: float, period: float) -> None:
        self._pace = pace
        self._period = period

    def __call__(
        self,
        state: PlantState,
        relative_pose: tuple[float, float, float],
        clearance: float,
        collision: bool,
        goal: bool,
    ) -> dict[str, float]:
        """Return the reward of each seat for the control step that ended in ``state``.

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
        _, offset, heading = relative_pose
        speed = state.twist[0]
        force = state.force_on_base
        # A third of the time that `mean` takes.
        fx, fy = np.add.reduce(force).tolist()
        effort = (fx * fx + fy * fy) / (len(force) * FORCE_SCALE) ** 2
        closeness = max(0.0, 1.0 - clearance / COMFORT)
        progress = speed * math.cos(heading) / self._pace
        human = progress - effort - 2.0 * closeness
        automation = progress - offset**2 - (speed / self._pace - 1.0) ** 2 - effort
        end = ARRIVAL * goal - FAILURE * collision
        return {
            "human": self._period * human + end,
            "automation": self._period * automation + end,
        }
