"""Sensors that can be bought, by name."""

from __future__ import annotations

from typing import Any

from ..basics.errors import InputError
from ..basics.parameters import parameters
from ..basics.registry import did_you_mean
from ..basics.validators import require
from .parameters import SensorParameters

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
    require(isinstance(name, str), "name", name, "the name of a preset is expected")
    if name == "none":
        return parameters("sensor", SensorParameters, changes)
    if name not in PRESETS:
        near = did_you_mean(str(name), list(PRESETS))
        raise InputError(f"unknown sensor preset {name!r}; {near}")
    return parameters("sensor", SensorParameters, vars(PRESETS[name][1]) | changes)


class Presets:
    """The presets as a registry: their names, what each stands for, and its parameters."""

    kind = "sensor preset"

    def names(self) -> list[str]:
        """Return all names of sensors that can be bought."""
        return list(PRESETS)

    def describe(self, name: str) -> str:
        """Return what a name stands for, in one line."""
        return PRESETS[name][0]

    def get(self, name: str) -> SensorParameters:
        """Return the parameters behind a name (see `sensor_preset`)."""
        return sensor_preset(name)


SENSOR_PRESETS = Presets()
