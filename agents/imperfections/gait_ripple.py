"""Gait ripple: the trunk sways as it walks, and the arm passes it on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import Range, require_ranges

from ..basics.elementwise import Value, elementwise
from .wrapper import Imperfection

RANGES: dict[str, Range] = {
    "step_frequency": (0.01, 4.0, "Hz"),
    "lateral_sway": (0.0, 1.0, "m"),
    "fore_aft_sway": (0.0, 1.0, "m"),
    "arm_stiffness": (0.0, 1e5, "N/m"),
    "walking_speed": (0.01, 5.0, "m/s"),
}
"""What walking people can do, and more (inferred)."""


@dataclass
class GaitRipple(Imperfection):
    """The sway of a walking trunk through the arm's stiffness, added to the force.

    Fore and aft the trunk sways at the step frequency, sideways at half of it:

        dF = walking stiffness/2 [fore_aft sin(phi), lateral sin(phi/2)], phi = 2 pi f t + phase.

    The defaults are those of the median person at 0.8 m/s, the pace of the scenarios that ship,
    from the sources in `cowalk.sim.body.gait`. They make +- 3 N sideways and 2 N fore and aft, as
    much as the paper's pushes. It ceases with the walk:
    ``walking = min(|v|/walking_speed, 1)``. For the unicycle plant; in PyBullet the body
    makes it.

    Parameters
    ----------
    human : Human
    step_frequency : float
        Hz.
    lateral_sway : float
        Sideways, peak to peak, m.
    fore_aft_sway : float
        Fore and aft, peak to peak, m.
    arm_stiffness : float
        N/m, about 100. Inferred.
    walking_speed : float
        Speed in m/s from which on the gait has its full sway. Inferred.

    Raises
    ------
    InputError
        If a number is outside of `RANGES`.
    """

    demonstration: ClassVar[tuple[float, float]] = (5.0, 10.0)

    step_frequency: float = 1.37
    lateral_sway: float = 0.067
    fore_aft_sway: float = 0.042
    arm_stiffness: float = 100.0
    walking_speed: float = 0.4

    @property
    def closed_loop(self) -> bool:
        """True around any human: the ripple follows the base's speed."""
        return True

    def __post_init__(self) -> None:
        super().__post_init__()
        require_ranges(self, RANGES, lanes=True)

    def unsuited(self, plant: str, period: float) -> str | None:
        """See `Imperfection.unsuited`."""
        if plant == "bullet":
            return (
                "gait-ripple is for the unicycle plant; on 'bullet' the body makes it: leave it "
                'out, and draw people with plant="bullet"'
            )
        return None

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        self._forward = 0.5 * self.arm_stiffness * self.fore_aft_sway
        self._sideways = 0.5 * self.arm_stiffness * self.lateral_sway
        self._advance = 2.0 * np.pi * self.step_frequency * situation.period
        self._phase: Value = None
        self._count = 0

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        m = elementwise(force)
        if self._phase is None:
            # Over two steps, since the first may be a left or a right one.
            (self._phase,) = m.parts(self._rng.uniform(0.0, 4.0 * np.pi, (*force.shape[:-1], 1)))
        (fx, fy), (v, _) = m.parts(force), m.parts(observation["twist"])
        angle = self._advance * self._count + self._phase
        self._count += 1
        walking = m.minimum(abs(v) / self.walking_speed, 1.0)
        return m.pair(
            force,
            fx + walking * self._forward * m.sin(angle),
            fy + walking * self._sideways * m.sin(0.5 * angle),
        )
