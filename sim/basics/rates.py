"""Rates of control, physics and force sensor."""

from __future__ import annotations

from dataclasses import dataclass

from .errors import InputError
from .validators import require_whole

FASTEST = 1_000_000
"""Hz: a physics step of a microsecond, where rounding begins to show (inferred)."""


@dataclass(frozen=True)
class Rates:
    """Rates of control, physics and force sensor in Hz, integers of one another.

    Raises
    ------
    InputError
        If one is no whole number from 1 to `FASTEST`, physics no multiple of control or of the
        sensor, or the sensor none of control.
    """

    control: int = 20
    physics: int = 240
    sensor: int = 240

    def __post_init__(self) -> None:
        for name in ("control", "physics", "sensor"):
            require_whole(name, getattr(self, name), 1, FASTEST, "Hz")
        for fast, slow in (("physics", "control"), ("sensor", "control"), ("physics", "sensor")):
            rate, base = getattr(self, fast), getattr(self, slow)
            if rate % base:
                near = max(1, round(rate / base)) * base
                what = f"is not a whole multiple of {slow} = {base} Hz; {near} would be"
                raise InputError(f"{fast} = {rate} Hz {what}")

    @property
    def period(self) -> float:
        """Control period in s."""
        return 1.0 / self.control

    @property
    def substeps(self) -> int:
        """Physics steps in a control step."""
        return self.physics // self.control

    @property
    def samples(self) -> int:
        """Force samples in a control step."""
        return self.sensor // self.control
