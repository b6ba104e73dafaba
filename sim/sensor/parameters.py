"""What a force-torque sensor does wrong, and three sensors that one can buy."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..basics.errors import InputError
from ..basics.validators import (
    Range,
    listed,
    require,
    require_flag,
    require_range,
    require_ranges,
)

LONGEST_LATENCY = 1.0
"""s; nobody walks by forces that are older, or are converted more seldom."""
RANGES: dict[str, Range] = {
    "rate": (1.0 / LONGEST_LATENCY, 1e6, "Hz"),
    "latency": (0.0, LONGEST_LATENCY, "s"),
    "low_pass": (0.1, 1e6, "Hz"),
    "range": (1e-3, 1e5, "N"),
    "resolution": (0.0, 1e4, "N"),
    "torque_range": (1e-3, 1e5, "N m"),
    "torque_resolution": (0.0, 1e4, "N m"),
    "drop_rate": (0.0, 0.99, ""),
}
RANGES_OF_AXES: dict[str, Range] = {
    "bias": (-1e4, 1e4, "N"),
    "drift": (-1e5, 1e5, "N/h"),
    "noise_density": (0.0, 100.0, "N/sqrt(Hz)"),
    "torque_bias": (-1e4, 1e4, "N m"),
    "torque_drift": (-1e5, 1e5, "N m/h"),
    "torque_noise_density": (0.0, 100.0, "N m/sqrt(Hz)"),
}
CROSS_TALK: Range = (0.0, 0.5, "")
"""Of the one share: at 1, all channels read the same."""
CROSS_TALK_ENTRY: Range = (-100.0, 100.0, "")
"""Of a matrix: in newtons a newton metre it may be well above 1.

All of these ranges are inferred, and generous: thousands of times what sensors on a handle do."""


@dataclass(frozen=True)
class SensorParameters:
    """A six-axis sensor without faults unless told otherwise.

    The load passes, in this order: cross-talk, zero offset (bias and drift) and noise, low-pass,
    saturation, quantisation, the sensor's own conversions, tare, latency, lost samples. Bias,
    drift and noise are one number for all three axes of the sensor, or a list for x, y and z (of
    two for x and y). What starts with ``torque_`` is for the torques, the same without for forces.

    Parameters
    ----------
    rate : float
        Conversions a second, Hz, to 1 mHz; between them the last one is read again. 0 converts at
        every sample of `cowalk.sim.basics.rates.Rates.sensor`, as does any rate above that.
    latency : float
        Delay from conversion to reading, s, rounded to whole samples.
    bias, torque_bias : float or list
        Constant zero offset, N and N m.
    drift, torque_drift : float or list
        Slope of the zero offset, N/h and N m/h.
    noise_density, torque_noise_density : float or list
        One-sided density of white noise ahead of the low-pass, N/sqrt(Hz) and N m/sqrt(Hz).
    low_pass : float
        -3 dB frequency of a second-order Butterworth low-pass, Hz; 0 is none.
    cross_talk : float or list of lists
        Share of full scale that every channel reads for a full scale of each other one (without
        ranges: of each other force for a force, of each other torque for a torque). Or the matrix
        of what a channel reads (rows) for a unit of each (columns), forces x, y, z then torques
        x, y, z, its diagonal being errors of gain; of 6, 3 or 2 rows, the rest being 0.
    range, torque_range : float
        Largest reading either way, N and N m, before the tare is taken off.
    resolution, torque_resolution : float
        Step between readings, N and N m; 0 is continuous.
    drop_rate : float
        Probability that a conversion is lost on its way; the last one is then read again, and
        flagged.
    tare : bool
        Take off what is read over 0.5 s before an episode, nobody pushing but a load clamped on.

    Raises
    ------
    InputError
        If a value is outside of `RANGES`, `RANGES_OF_AXES`, `CROSS_TALK` or `CROSS_TALK_ENTRY`,
        a list or a matrix not made for six channels, or a resolution above its range.
    """

    rate: float = 0.0
    latency: float = 0.0
    bias: float | tuple[float, ...] = 0.0
    drift: float | tuple[float, ...] = 0.0
    noise_density: float | tuple[float, ...] = 0.0
    low_pass: float = 0.0
    cross_talk: float | tuple[tuple[float, ...], ...] = 0.0
    range: float = math.inf
    resolution: float = 0.0
    torque_bias: float | tuple[float, ...] = 0.0
    torque_drift: float | tuple[float, ...] = 0.0
    torque_noise_density: float | tuple[float, ...] = 0.0
    torque_range: float = math.inf
    torque_resolution: float = 0.0
    drop_rate: float = 0.0
    tare: bool = False

    def __post_init__(self) -> None:
        require_flag("tare", self.tare)
        require_ranges(self, RANGES)
        for name, within in RANGES_OF_AXES.items():
            axes = listed(getattr(self, name))
            object.__setattr__(self, name, axes)
            if isinstance(axes, tuple) and len(axes) not in (2, 3):
                raise InputError(
                    f"{name} has {len(axes)} entries; give one number, or 3 for x, y and z, "
                    "or 2 for x and y",
                    (name,),
                )
            for value in axes if isinstance(axes, tuple) else (axes,):
                require_range(name, value, within)
        self._require_cross_talk()
        for step, limit, unit in (
            ("resolution", "range", "N"),
            ("torque_resolution", "torque_range", "N m"),
        ):
            value, most = getattr(self, step), getattr(self, limit)
            what = f"must not be above {limit} = {most} {unit}, else nothing but 0 is read"
            require(value <= most, step, value, what, unit)

    def _require_cross_talk(self) -> None:
        given = listed(self.cross_talk)
        object.__setattr__(self, "cross_talk", given)
        if not isinstance(given, tuple):
            require_range("cross_talk", given, CROSS_TALK)
            return
        rows = [isinstance(row, tuple) and len(row) for row in given]
        what = (
            "give one number, or 6 rows of 6, or 3 of 3 for forces, or 2 of 2 for those along x "
            "and y"
        )
        require(rows in ([2] * 2, [3] * 3, [6] * 6), "cross_talk", given, what)
        for row in given:
            for value in row:
                require_range("cross_talk", value, CROSS_TALK_ENTRY)
