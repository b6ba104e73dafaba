"""A table of single force samples beside a trace: what a front end is scored on."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.rates import Rates
from cowalk.sim.env.env import CowalkEnv

from .parquet import write_columns
from .trace import FORMAT

_AXES = ("force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z")
_UNITS_OF_AXES = ("N", "N", "N", "N m", "N m", "N m")
UNITS = {
    "t": "s",
    **{f"interaction_{axis}": unit for axis, unit in zip(_AXES, _UNITS_OF_AXES, strict=True)},
    **{f"measured_{axis}": unit for axis, unit in zip(_AXES, _UNITS_OF_AXES, strict=True)},
    "valid": "1",
    "saturated": "1",
}
"""Every column and its unit.

``interaction_...`` is the wrench of the human on the base before the sensor, ``measured_...``
what was read of it, both in base axes about the handle; ``valid`` is 0 where a sample was lost
and repeats the one before, ``saturated`` 1 where a channel was at the end of its range.
"""


class SampleTable:
    """One row a force sample.

    Parameters
    ----------
    rates : Rates
    """

    def __init__(self, rates: Rates) -> None:
        self._rate = rates.sensor
        self._blocks: list[Array] = []

    def add(self, env: CowalkEnv) -> None:
        """Keep the samples of the control step that the environment has just taken."""
        reading = env.sensor_reading
        flags = np.stack((reading.valid, reading.saturated), axis=-1)
        true = env.plant_state.wrench_on_base
        self._blocks.append(np.concatenate((true, reading.wrench_on_base, flags), axis=-1))

    def __len__(self) -> int:
        return sum(len(block) for block in self._blocks)

    def columns(self) -> dict[str, Array]:
        """Return every column by name, each of shape (rows,)."""
        width = len(UNITS) - 1
        values = np.concatenate(self._blocks) if self._blocks else np.empty((0, width))
        time = np.arange(1, len(values) + 1) / self._rate
        return dict(zip(UNITS, (time, *values.T), strict=True))

    def write(self, file: Path) -> None:
        """Write a Parquet file whose fields carry their unit as metadata ``unit``."""
        write_columns(file, self.columns(), UNITS, FORMAT, whole=("valid", "saturated"))
