"""Rates of control, physics and force sensor."""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Integral

from .errors import InputError
from .validators import shown


def _ratio(fast_name: str, fast: int, slow_name: str, slow: int) -> int:
    for name, rate in ((fast_name, fast), (slow_name, slow)):
        if not isinstance(rate, Integral) or isinstance(rate, bool):
            raise InputError(f"rates.{name} = {shown(rate)}: a whole number is expected, in Hz")
    if slow <= 0:
        raise InputError(f"rates.{slow_name} = {slow} Hz: it must be above 0")
    if fast < slow or fast % slow:
        raise InputError(
            f"rates.{fast_name} = {fast} Hz is not a whole multiple of {slow_name} = {slow} Hz; "
            f"{max(1, round(fast / slow)) * slow} would be"
        )
    return fast // slow


@dataclass(frozen=True)
class Rates:
    """Rates of control, physics and force sensor in Hz, integers of one another.

    Raises
    ------
    InputError
        If one is no whole number above 0, physics no multiple of control or of the sensor, or the
        sensor none of control.
    """

    control: int = 20
    physics: int = 240
    sensor: int = 240

    def __post_init__(self) -> None:
        _ratio("physics", self.physics, "control", self.control)
        _ratio("sensor", self.sensor, "control", self.control)
        _ratio("physics", self.physics, "sensor", self.sensor)

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
