"""Trunk sway of a walking human: how far, how often, and in which phase. Plain floats.

The trunk sways fore and aft once a step and from side to side once a stride (two steps). That is
a motion of the trunk, not a force: what of it reaches the handle is the arm's business.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..basics.validators import Range, require_flag, require_ranges

PERCENTILES = (5.0, 50.0, 95.0)
FORE_AFT, LATERAL = (0.036, 0.066, 0.159), (0.027, 0.060, 0.115)
"""Peak-to-peak sway of the trunk at `PERCENTILES`, m, and
"""
STEP_FREQUENCY = (1.63, 1.82, 2.08)
"""step frequency, Hz, measured over 110 walking trials at the walkers' own speed. Handed down with
the project's model; the publication behind them was searched for and not found, so treat the
5-95 % band as unconfirmed. Other people's cadence lies within it: 117 steps a minute, 1.95 Hz, at
1.31 m/s (women) and 1.54 m/s (men; Murray and others 1964 and 1970, as tabulated by D. Thompson,
University of Oklahoma, "Stride analysis")."""
PREFERRED_SPEED = 1.3
"""Speed to which the step frequencies belong, m/s. Inferred: comfortable speed of adults
(1.27-1.46 m/s, Bohannon 1997, Age and Ageing 26:15); the trials do not state theirs."""
CADENCE_EXPONENT = 0.58
"""Step frequency grows with speed^0.58, as step length grows with speed^0.42. That adults follow a
power of speed is from Grieve and Gear (1966, Ergonomics 9:379, 10.1080/00140136608964399), of which
the abstract could be read; the exponent goes under Grieve's name in the models of Kuo and others
(2001, J Biomech Eng 123:264; their code for a rimless wheel has s = v^0.42, "Grieve eqn")."""
FULL_SPEED = 0.3
"""Speed below which the sway shrinks in proportion, m/s (inferred): standing still is still."""
PACE_LAG = 0.5
"""Time constant with which the cadence follows the speed, s (inferred)."""
RANGES: dict[str, Range] = {
    "percentile": (PERCENTILES[0], PERCENTILES[-1], ""),
    "step_frequency": (0.5, 4.0, "Hz"),
    "fore_aft": (0.0, 0.3, "m"),
    "lateral": (0.0, 0.3, "m"),
}
"""What was measured, and beyond it what walking people can do (inferred)."""


@dataclass(frozen=True)
class GaitParameters:
    """How a human sways.

    Parameters
    ----------
    enabled : bool
        Without it the trunk glides.
    percentile : float
        Of the measured sway, 5 to 95; between 5, 50 and 95 by the logarithm.
    fore_aft, lateral : float, optional
        Peak-to-peak sway of the trunk, m, instead of the percentile's.
    step_frequency : float
        At `PREFERRED_SPEED`, Hz. Measured: 1.63, 1.82, 2.08 Hz at 5, 50, 95 %.

    Raises
    ------
    InputError
        If the percentile or a size is out of range.
    """

    enabled: bool = False
    percentile: float = 50.0
    fore_aft: float | None = None
    lateral: float | None = None
    step_frequency: float = STEP_FREQUENCY[1]

    def __post_init__(self) -> None:
        require_flag("enabled", self.enabled)
        require_ranges(self, RANGES)

    @property
    def sway(self) -> tuple[float, float]:
        """Peak-to-peak sway fore-aft and lateral, m."""
        fore_aft, lateral = sway_at(self.percentile)
        return (
            fore_aft if self.fore_aft is None else self.fore_aft,
            lateral if self.lateral is None else self.lateral,
        )


def sway_at(percentile: float) -> tuple[float, float]:
    """Return the measured peak-to-peak sway, fore-aft and lateral, m, at a percentile (5 to 95)."""
    fore_aft, lateral = (
        math.exp(float(np.interp(percentile, PERCENTILES, np.log(sizes))))
        for sizes in (FORE_AFT, LATERAL)
    )
    return fore_aft, lateral


def step_frequency(speed: float, preferred: float = STEP_FREQUENCY[1]) -> float:
    """Return the step frequency at a speed (m/s), Hz, given that at the preferred speed."""
    share: float = (abs(speed) / PREFERRED_SPEED) ** CADENCE_EXPONENT
    return preferred * share


Sway = tuple[float, float, float, float, float, float]
"""Where the trunk is beside its mean: x, y in m, their rates in m/s, accelerations in m/s^2."""


class Gait:
    """Sway of the trunk as it walks; amplitude and cadence follow the speed.

    x = A_x/2 sin(2 phi), y = A_y/2 sin(phi), phi' = pi f_step: phi is the phase of the stride.

    Parameters
    ----------
    parameters : GaitParameters
    step : float
        Time between updates, s.
    """

    def __init__(self, parameters: GaitParameters, step: float) -> None:
        self.enabled = parameters.enabled
        fore_aft, lateral = parameters.sway
        self._half = (fore_aft / 2.0, lateral / 2.0)
        self._preferred = parameters.step_frequency
        self._step = step
        self._share = step / PACE_LAG
        self._phase = self._speed = 0.0

    def reset(self, rng: np.random.Generator, speed: float = 0.0) -> None:
        """Walk at a speed (m/s), 0 to stand, and choose where in the stride that starts."""
        self._speed = speed
        self._phase = float(rng.uniform(0.0, math.tau)) if self.enabled else 0.0

    def update(self, speed: float) -> Sway:
        """Return the sway now, at a speed (m/s), and go on by one step.

        The acceleration is that of half a step ahead: it is what acts until the next update.
        """
        self._speed += self._share * (speed - self._speed)
        now = self.sway()
        self._phase = (self._phase + self._rate() * self._step) % math.tau
        return now

    def _rate(self) -> float:
        """Return the rate of the stride's phase, rad/s."""
        return math.pi * step_frequency(self._speed, self._preferred)

    def sway(self) -> Sway:
        """Return the sway now, as `update` does, without going on."""
        pace, phase, rate = abs(self._speed), self._phase, self._rate()
        size = pace / FULL_SPEED if pace < FULL_SPEED else 1.0
        fore, side = self._half[0] * size, self._half[1] * size
        sin, cos, twice = math.sin(phase), math.cos(phase), 2.0 * rate
        x, y = fore * 2.0 * sin * cos, side * sin
        vx, vy = twice * fore * (1.0 - 2.0 * sin * sin), rate * side * cos
        ahead = 0.5 * self._step
        return x, y, vx, vy, -twice * twice * (x + ahead * vx), -rate * rate * (y + ahead * vy)

    @property
    def phase(self) -> float:
        """Phase of the stride, rad."""
        return self._phase

    def save(self) -> tuple[float, float]:
        """Return what `restore` takes."""
        return self._phase, self._speed

    def restore(self, saved: tuple[float, float]) -> None:
        """Go on from a saved state."""
        self._phase, self._speed = saved
