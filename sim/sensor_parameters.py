"""What a force-torque sensor does wrong, and three sensors that one can buy."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from .errors import InputError
from .parameters import Range, parameters, require_flag, require_range, require_ranges, shown
from .registry import did_you_mean

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
        every sample of `cowalk.sim.plant.Rates.sensor`, as does any rate above that.
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
            axes = _tuples(getattr(self, name))
            object.__setattr__(self, name, axes)
            if isinstance(axes, tuple) and len(axes) not in (2, 3):
                raise InputError(
                    f"{name} has {len(axes)} entries; give one number, or 3 for x, y and z, "
                    "or 2 for x and y"
                )
            for value in axes if isinstance(axes, tuple) else (axes,):
                require_range(name, value, within)
        self._require_cross_talk()
        for step, limit, unit in (
            ("resolution", "range", "N"),
            ("torque_resolution", "torque_range", "N m"),
        ):
            if getattr(self, step) > getattr(self, limit):
                raise InputError(
                    f"{step} = {getattr(self, step)} {unit}: must not be above "
                    f"{limit} = {getattr(self, limit)} {unit}, else nothing but 0 is read"
                )

    def _require_cross_talk(self) -> None:
        given = _tuples(self.cross_talk)
        object.__setattr__(self, "cross_talk", given)
        if not isinstance(given, tuple):
            require_range("cross_talk", given, CROSS_TALK)
            return
        rows = [isinstance(row, tuple) and len(row) for row in given]
        if rows not in ([2] * 2, [3] * 3, [6] * 6):
            raise InputError(
                f"cross_talk = {shown(given)}: give one number, or 6 rows of 6, or 3 of 3 for "
                "forces, or 2 of 2 for those along x and y"
            )
        for row in given:
            for value in row:
                require_range("cross_talk", value, CROSS_TALK_ENTRY)


def _tuples(value: Any) -> Any:
    """Return lists and arrays as tuples, which can be compared and stay as they are."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    return tuple(map(_tuples, value)) if isinstance(value, list | tuple) else value


PRESETS: dict[str, tuple[str, SensorParameters]] = {
    "laboratory": (
        "six-axis strain gauge transducer with its own electronics, as ATI's Axia80-M20",
        SensorParameters(
            # 44 mN over 100 Hz for 1000 N (x-tech.studio, "Understanding noise sources in 6-axis
            # force-torque sensors"); half of it for half the range.
            noise_density=0.0022,
            # 500 N, and 1e6 counts per N (ATI 9610-05 Ethernet Axia, tables 4.8 and 8.3).
            range=500.0,
            resolution=1e-6,
            rate=1000.0,  # typical; these convert at up to 8 kHz and are read at 1 kHz
            low_pass=100.0,  # typical choice among the electronics' own filters
            latency=0.001,  # typical: one period of the field bus
            bias=2.0,  # typical, before the tare
            drift=0.1,  # typical after warming up
            # 20 N m, and 1e6 counts per N m (the same tables).
            torque_range=20.0,
            torque_resolution=1e-6,
            # Typical: the same shares of full scale as for forces.
            torque_noise_density=8.8e-5,
            torque_bias=0.08,
            torque_drift=0.004,
            cross_talk=0.01,  # typical
            tare=True,
        ),
    ),
    "industrial": (
        "six-axis sensor of a collaborative robot's wrist, as Robotiq's FT 300-S",
        SensorParameters(
            # 100 messages a second, whole hundredths of a newton (Robotiq FT 300-S instruction
            # manual, section 4.4.2 "Data stream").
            rate=100.0,
            resolution=0.01,
            # 300 N with 0.1 N of noise (roboticscenter.ai, force/torque sensor selection guide),
            # taken as its deviation behind a low-pass of 40 Hz, which is typical.
            range=300.0,
            noise_density=0.015,
            low_pass=40.0,
            latency=0.01,  # typical: one message
            bias=5.0,  # typical, before the tare
            drift=1.0,  # typical
            # Whole thousandths of a newton metre (section 4.4.2); 30 N m
            # (industrialmonitordirect.com, "Robotiq FT 300 path recording without sensor").
            torque_resolution=0.001,
            torque_range=30.0,
            # Typical: the same shares of full scale as for forces.
            torque_noise_density=0.0015,
            torque_bias=0.5,
            torque_drift=0.1,
            cross_talk=0.02,  # typical: "good sensors" stay below 2 %
            drop_rate=0.001,  # typical of a serial line
            tare=True,
        ),
    ),
    "low-cost": (
        "bar load cells of 20 kg on HX711 converters",
        SensorParameters(
            # 80 conversions a second with 90 nV of noise (SparkFun, OpenScale hookup guide, after
            # Avia's HX711 data sheet).
            rate=80.0,
            low_pass=20.0,  # typical: the chip averages over a few conversions
            latency=0.0125,  # typical: one conversion
            # 90 nV is 0.0007 N/sqrt(Hz) where 196 N give 5 mV; supply, wiring and cell raise it,
            # typically by ten.
            noise_density=0.007,
            range=196.0,  # 20 kg
            resolution=0.02,  # typical: 2 g
            bias=10.0,  # zero balance of 5 % of the rated output (senstech.co.kr, terms)
            drift=5.0,  # typical: creep, and a zero that follows the temperature
            # Typical: such cells 0.1 m from the axis, so that a newton is 0.1 N m.
            torque_range=19.6,
            torque_resolution=0.002,
            torque_noise_density=0.0007,
            torque_bias=1.0,
            torque_drift=0.5,
            cross_talk=0.05,  # typical of single-axis cells bolted together
            drop_rate=0.01,  # typical of a line driven by software
            tare=True,
        ),
    ),
}
"""Description and parameters by name. What no source is named for is typical, not looked up."""


def sensor_preset(name: str, **changes: Any) -> SensorParameters:
    """Return the parameters of a preset, some of them changed.

    Parameters
    ----------
    name : str
        ``laboratory``, ``industrial``, ``low-cost``, or ``none`` for one without faults.
    **changes
        See `SensorParameters`.

    Raises
    ------
    InputError
        If there is no such preset, or a change is refused.
    """
    if name == "none":
        return parameters("sensor", SensorParameters, changes)
    if name not in PRESETS:
        near = did_you_mean(str(name), list(PRESETS))
        raise InputError(f"unknown sensor preset {name!r}; {near}")
    return parameters("sensor", SensorParameters, vars(PRESETS[name][1]) | changes)
