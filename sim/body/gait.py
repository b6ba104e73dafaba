"""Trunk sway of a walking human: how far, how often, and in which phase. Plain floats.

The trunk sways fore and aft once a step and from side to side once a stride (two steps). That is
a motion of the trunk, not a force: what of it reaches the handle is the arm's business.

The trunk is taken to move as the body's centre of mass (inferred). That walks a figure of eight of
some 18 cm beside its mean, in three dimensions, narrower the faster (Tesio and Rota 2019,
10.3389/fneur.2019.00999; Malloggi and others 2019, 10.1097/MRR.0000000000000345; read in their
abstracts). How far it goes is from `LATERAL` and `VERTICAL`; fore and aft no number could be read,
so that follows from the vertical motion (`fore_aft`). At 1.3 m/s the three make a path of 24 cm,
20 cm without the motion fore and aft: the two sources differ. That people do, by age too
(Hernandez and others 2009, Gait & Posture 30:217), is known; how much, of the vertical motion
alone (`SPREAD`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from ..basics.frames import GRAVITY
from ..basics.validators import Range, require_flag, require_ranges

SPEEDS = (0.7, 1.6)
"""Speeds at which the centre of mass was measured, m/s: beyond them the sway stays as it is."""
LATERAL, VERTICAL = (0.070, 0.039), (0.027, 0.048)
"""Its motion from side to side and up and down, peak to peak, at `SPEEDS`, m: Orendurff and others
2004, J Rehabil Res Dev 41:829, as several others quote it; the tables could not be read. In between
they are taken to go in proportion (inferred)."""
SPREAD = 0.19
"""Standard deviation over the mean from person to person: of the vertical motion 0.5 in 2.7 cm and
0.9 in 4.8 cm (Orendurff and others 2004, as quoted). That it holds for the others is inferred."""
STEP_FREQUENCY = 1.82
"""Step frequency at `PREFERRED_SPEED`, Hz: twice the 64.8 (v/stature)^0.57 strides a minute of men
(Grieve and Gear 1966, Ergonomics 9:379, as quoted elsewhere), for 1.75 m. Others measured 117 steps
a minute, 1.95 Hz, at 1.31 m/s (women) and 1.54 m/s (men; Murray and others 1964 and 1970, as
tabulated by D. Thompson, University of Oklahoma, "Stride analysis")."""
PREFERRED_SPEED = 1.3
"""Speed to which step frequencies and sizes belong, m/s: about the comfortable speed of adults
(1.27-1.46 m/s, Bohannon 1997, Age and Ageing 26:15)."""
CADENCE_EXPONENT = 0.58
"""Step frequency grows with speed^0.58, as step length grows with speed^0.42. That adults follow a
power of speed is from Grieve and Gear (1966, Ergonomics 9:379, 10.1080/00140136608964399), of which
the abstract could be read; the exponent goes under Grieve's name in the models of Kuo and others
(2001, J Biomech Eng 123:264; their code for a rimless wheel has s = v^0.42, "Grieve eqn")."""
FULL_SPEED = 0.3
"""Speed below which the sway shrinks in proportion, m/s (inferred): standing still is still."""
PACE_LAG = 0.5
"""Time constant with which the cadence follows the speed, s (inferred)."""
PERCENTILES = (5.0, 95.0)
RANGES: dict[str, Range] = {
    "percentile": (*PERCENTILES, ""),
    "step_frequency": (0.5, 4.0, "Hz"),
    "fore_aft": (0.0, 0.3, "m"),
    "lateral": (0.0, 0.3, "m"),
}
"""What walking people can do (inferred)."""


@dataclass(frozen=True)
class GaitParameters:
    """How a human sways.

    Parameters
    ----------
    enabled : bool
        Without it the trunk glides.
    percentile : float
        Of people by the size of their sway, 5 to 95; its logarithm has the deviation `SPREAD`.
    fore_aft, lateral : float, optional
        Peak-to-peak sway of the trunk at `PREFERRED_SPEED`, m, instead of the percentile's.
    step_frequency : float
        At `PREFERRED_SPEED`, Hz.

    Raises
    ------
    InputError
        If the percentile or a size is out of range.
    """

    enabled: bool = False
    percentile: float = 50.0
    fore_aft: float | None = None
    lateral: float | None = None
    step_frequency: float = STEP_FREQUENCY

    def __post_init__(self) -> None:
        require_flag("enabled", self.enabled)
        require_ranges(self, RANGES)

    @property
    def sway(self) -> tuple[float, float]:
        """Peak-to-peak sway fore-aft and lateral at `PREFERRED_SPEED`, m."""
        size = math.exp(SPREAD * NormalDist().inv_cdf(self.percentile / 100.0))
        return (
            size * fore_aft(PREFERRED_SPEED) if self.fore_aft is None else self.fore_aft,
            size * lateral(PREFERRED_SPEED) if self.lateral is None else self.lateral,
        )

    def sway_at(self, speed: float) -> tuple[float, float]:
        """Return the peak-to-peak sway fore-aft and lateral at a walking speed (m/s), m."""
        (ahead, aside), (along, across) = self.sway, growth(abs(speed))
        return along * ahead, across * aside


def lateral(speed: float) -> float:
    """Return the sway from side to side of the median person, peak to peak, m."""
    return _between(LATERAL, speed)


def fore_aft(speed: float) -> float:
    """Return the sway fore and aft of the median person, peak to peak, m.

    A = g A_z/(2 pi f v): of the kinetic energy of the way ahead as much comes and goes as of the
    potential energy of the vertical motion A_z, at the step frequency f, as of an inverted pendulum
    (the model of Zijlstra and Hof 1997, Gait & Posture 6:249, read in its abstract).

    Parameters
    ----------
    speed : float
        v, m/s.
    """
    v = _measured(speed)
    return GRAVITY * _between(VERTICAL, v) / (math.tau * step_frequency(v) * v)


def growth(speed: float) -> tuple[float, float]:
    """Return the sway fore-aft and lateral over that at `PREFERRED_SPEED`; it fades in standing."""
    size = speed / FULL_SPEED if speed < FULL_SPEED else 1.0
    return size * fore_aft(speed) / _AHEAD, size * lateral(speed) / _ASIDE


def _measured(speed: float) -> float:
    """Return the nearest speed at which the centre of mass was measured, m/s."""
    slowest, fastest = SPEEDS
    return slowest if speed < slowest else fastest if speed > fastest else speed


def _between(sizes: tuple[float, float], speed: float) -> float:
    slowest, fastest = SPEEDS
    share = (_measured(speed) - slowest) / (fastest - slowest)
    return sizes[0] + share * (sizes[1] - sizes[0])


def step_frequency(speed: float, preferred: float = STEP_FREQUENCY) -> float:
    """Return the step frequency at a speed (m/s), Hz, given that at the preferred speed."""
    share: float = (abs(speed) / PREFERRED_SPEED) ** CADENCE_EXPONENT
    return preferred * share


_AHEAD, _ASIDE = fore_aft(PREFERRED_SPEED), lateral(PREFERRED_SPEED)

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
        along, across = growth(pace)
        fore, side = along * self._half[0], across * self._half[1]
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
