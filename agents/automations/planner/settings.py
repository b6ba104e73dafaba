"""What every negotiating automation shares: weights, horizon, period, and how force is read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from cowalk.sim.basics.errors import InputError


@dataclass(frozen=True)
class NegotiationSettings:
    """Settings of the negotiation of Schneider et al. (arXiv 2407.17275).

    The paper prints only ``l = 5`` and v = 0.8 m/s; every default here is inferred, by
    ``cowalk paper --calibrate`` where the paper's scenario determines it.

    Parameters
    ----------
    dimensions : {"omega", "both"}
        Whether omega alone is negotiated at the usual pace, as in the paper, or v as well.
    period : float
        Time between negotiations in s, a whole multiple of the control period.
    horizon : float
        Time tau in s over which a motion primitive is held in prediction.
    distance_weight, speed_weight, turn_weight : float
        w1 (1/m^2), w2 (s^2/m^2), w3 (s^2/rad^2) of J = w1 d^2 + w2 v^2 + w3 omega^2.
    force_max : (float, float)
        Force in N, forward and sideways, that is read as full insistence.
    force_threshold : (float, float)
        Force in N below which no wish is read.
    force_window : float
        Time in s over which the force is averaged before it is read; 0 is the last control
        step alone, as in the paper. A stride (two steps, about 1.4 s at 0.8 m/s) takes out the
        sway of a walking human, which reading once a period would alias into a slow wish.
    sensitivity : (float, float)
        f_v and f_omega: share of the upper bound that a full force asks for.

    Raises
    ------
    InputError
        If a value is out of its range.
    """

    dimensions: Literal["omega", "both"] = "omega"
    period: float = 0.7
    horizon: float = 2.32
    distance_weight: float = 1.0
    speed_weight: float = 0.0
    turn_weight: float = 0.069
    force_max: tuple[float, float] = (7.5, 7.5)
    force_threshold: tuple[float, float] = (0.0, 0.0)
    force_window: float = 0.0
    sensitivity: tuple[float, float] = (0.5, 0.5)

    def __post_init__(self) -> None:
        for names, holds, what in (
            (("period", "horizon", "distance_weight", "force_max"), np.greater, "above 0"),
            (("speed_weight", "turn_weight", "force_window"), np.greater_equal, "at least 0"),
            (("force_threshold", "sensitivity"), np.greater_equal, "at least 0"),
        ):
            for name in names:
                value = getattr(self, name)
                if not np.all(holds(value, 0.0)):
                    raise InputError(f"{name} = {value}: must be {what}")

    def steps(self, control_period: float) -> int:
        """Return the number of control steps between negotiations.

        Raises
        ------
        InputError
            If the period is not a whole multiple of the control period.
        """
        ratio = self.period / control_period
        if ratio < 0.5 or abs(ratio - round(ratio)) > 1e-6:
            raise InputError(
                f"automation.negotiation.period = {self.period} s is not a whole multiple of the "
                f"control period {control_period:g} s; "
                f"{max(1, round(ratio)) * control_period:g} would be"
            )
        return round(ratio)
