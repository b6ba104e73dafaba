"""What an environment is made with, judged before anything is built."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..basics.motion import TwistBounds
from ..basics.rates import Rates
from ..basics.validators import (
    Range,
    require,
    require_choices,
    require_instance,
    require_ranges,
    require_text,
)
from ..sensor.parameters import SensorParameters
from ..world.world import World
from .reward import RewardParameters

RANGES: dict[str, Range] = {
    "pace": (0.01, 5.0, "m/s"),
    "duration": (0.01, 86400.0, "s"),
    "force_limit": (0.1, 1000.0, "N"),
}
"""What two who walk together can have, for a day at most (inferred)."""

STARTS = ("pace", "standing")
"""At the usual walking speed, or at rest."""

_KINDS: dict[str, tuple[type, str]] = {
    "world": (World, "a World"),
    "plant": (str, "the name of a plant, or module:Class,"),
    "plant_parameters": (Mapping, "a mapping of the plant's parameters"),
    "rates": (Rates, "Rates"),
    "sensor": (SensorParameters, "SensorParameters, or the name of a preset,"),
    "bounds": (TwistBounds, "TwistBounds"),
}


@dataclass(frozen=True)
class Configuration:
    """What `cowalk.sim.env.env.CowalkEnv` is made with; its docstring says what they are.

    Raises
    ------
    InputError
        If one is of the wrong kind or outside of `RANGES`, or the pace above the bounds.
    """

    world: World
    plant: str
    plant_parameters: Mapping[str, Any]
    rates: Rates
    sensor: SensorParameters
    bounds: TwistBounds
    pace: float
    duration: float
    force_limit: float
    reward: RewardParameters = RewardParameters()
    start: str = "pace"

    def __post_init__(self) -> None:
        for name, (kind, words) in _KINDS.items():
            require_instance(name, getattr(self, name), kind, words)
        for key in self.plant_parameters:
            require_text("plant_parameters", key, "the name of a parameter")
        require_ranges(self, RANGES)
        require_choices(self, {"start": STARTS})
        # A copy: what is done to theirs later changes nothing here.
        object.__setattr__(self, "plant_parameters", dict(self.plant_parameters))
        require_reachable(self.pace, self.bounds)

    @property
    def initial_twist(self) -> tuple[float, float]:
        """Twist (v, omega) of the base at the start, within the bounds, m/s and rad/s."""
        if self.start == "standing":
            return 0.0, 0.0
        (slowest, right), (_, left) = self.bounds.lower, self.bounds.upper
        return max(self.pace, slowest), min(max(0.0, right), left)

    @property
    def steps(self) -> int:
        """Control steps of an episode that nothing ends."""
        return max(1, round(self.duration * self.rates.control))


def require_reachable(pace: float, bounds: TwistBounds) -> None:
    """Refuse a usual walking speed (m/s) that no action reaches.

    Raises
    ------
    InputError
        With both speeds.
    """
    fastest = bounds.upper[0]
    what = (
        f"must not be above the upper bound of v, {fastest:g} m/s (bounds.upper); give a pace of "
        "that or less, or raise it"
    )
    require(pace <= fastest, "pace", pace, what, "m/s")
