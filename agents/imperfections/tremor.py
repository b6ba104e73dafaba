"""Tremor: a force that shakes at 8 to 12 Hz."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import SHARE, Range, require_ranges

from ..basics.elementwise import Value, elementwise
from .wrapper import Imperfection

FREQUENCY: Range = (1.0, 30.0, "Hz")
"""Inferred."""


@dataclass
class Tremor(Imperfection):
    """A sinusoidal share of the force, F (1 + share sin(2 pi f t + phase)).

    Physiological tremor lies at 8 to 12 Hz (Novak and Newell 2017) and grows with the force,
    while its frequency stays (Sutton and Sykes 1967); the phase is drawn for each direction. A
    human decides a force once a control step and the plant holds it, so 20 Hz control ends at
    the Nyquist frequency of 10 Hz: a tremor of 11 Hz would come out at 9 Hz, and is refused.
    Holding also passes only sinc(f period) of the amplitude (0.70 at 9 Hz, 20 Hz) and adds an
    image at 1/period - f. Where the tremor itself is the subject, raise ``rates.control`` to
    60 Hz or more, for which the upper half of the band is there and 0.94 of the amplitude
    arrives at 12 Hz.

    Parameters
    ----------
    human : Human
    share : float
        Amplitude as a share of the force. Inferred: about 0.01.
    frequency : float
        Hz, in [1, 30] and below half of the control rate. The default is what 20 Hz control
        can hold of the band of 8 to 12 Hz.

    Raises
    ------
    InputError
        If the share is not in [0, 1] or the frequency not in [1, 30]; on reset, if it is not
        below half of the control rate.
    """

    share: float = 0.01
    frequency: float = 9.0

    def __post_init__(self) -> None:
        super().__post_init__()
        require_ranges(self, {"share": SHARE, "frequency": FREQUENCY})

    def unsuited(self, plant: str, period: float) -> str | None:
        """See `Imperfection.unsuited`."""
        rate = 1.0 / period
        if self.frequency < rate / 2.0:
            return None
        return (
            f"frequency = {self.frequency:g} Hz cannot be in a force decided at {rate:g} Hz, it "
            f"would alias to {abs(rate - self.frequency):g} Hz; stay below {rate / 2.0:g} Hz or "
            f"set rates.control above {2.0 * self.frequency:g}"
        )

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        super().reset(rng, situation)
        if reason := self.unsuited("", situation.period):
            raise InputError(f"tremor: {reason}")
        self._advance = 2.0 * np.pi * self.frequency * situation.period
        self._phase: tuple[Value, Value] | None = None
        self._count = 0

    def distort(self, force: Array, observation: Observation) -> Array:
        """See `Imperfection.distort`."""
        m = elementwise(force)
        if self._phase is None:
            self._phase = m.parts(self._rng.uniform(0.0, 2.0 * np.pi, force.shape))
        (fx, fy), (phase_x, phase_y) = m.parts(force), self._phase
        angle = self._advance * self._count
        self._count += 1
        return m.pair(
            force,
            fx * (1.0 + self.share * m.sin(angle + phase_x)),
            fy * (1.0 + self.share * m.sin(angle + phase_y)),
        )
