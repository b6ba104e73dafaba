"""What every negotiating automation shares: weights, horizon, period, and how force is read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.validators import Range, require_choices, require_ranges

RANGES: dict[str, Range] = {
    "period": (1e-3, 3600.0, "s"),
    "horizon": (1e-3, 1000.0, "s"),
    "distance_weight": (1e-6, 1e6, "1/m^2"),
    "speed_weight": (0.0, 1e6, "s^2/m^2"),
    "turn_weight": (0.0, 1e6, "s^2/rad^2"),
    "force_window": (0.0, 3600.0, "s"),
}
RANGES_OF_PAIRS: dict[str, Range] = {
    "force_max": (1e-3, 1e4, "N"),
    "force_threshold": (0.0, 1e4, "N"),
    "sensitivity": (0.0, 100.0, ""),
}
"""What two can negotiate with, and far more (inferred)."""
DIMENSIONS = ("omega", "both")


@dataclass(frozen=True)
class NegotiationSettings:
    """Settings of the negotiation of Schneider et al. (arXiv 2407.17275).

    The paper prints only ``l = 5`` and v = 0.8 m/s; every default here is inferred. What its
    own scenario is run with, ``paper-open-loop`` says (docs/model.md).

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
        If a value is outside of `RANGES` or `RANGES_OF_PAIRS`, or the dimensions are unknown.
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
        require_choices(self, {"dimensions": DIMENSIONS})
        require_ranges(self, RANGES, lanes=True)
        require_pairs(self, RANGES_OF_PAIRS, axis=-1)

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
                f"{max(1, round(ratio)) * control_period:g} would be",
                ("automation", "negotiation", "period"),
            )
        return round(ratio)
