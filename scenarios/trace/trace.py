"""The trace of a run: one row a control step, one column a quantity."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

if TYPE_CHECKING:
    pass

UNITS = {
    "t": "s",
    "x": "m",
    "y": "m",
    "theta": "rad",
    "v": "m/s",
    "omega": "rad/s",
    "v_cmd": "m/s",
    "omega_cmd": "rad/s",
    "fx": "N",
    "fy": "N",
    "sensor_force_x": "N",
    "sensor_force_y": "N",
    "sensor_force_z": "N",
    "sensor_torque_x": "N m",
    "sensor_torque_y": "N m",
    "sensor_torque_z": "N m",
    "fx_intent": "N",
    "fy_intent": "N",
    "human_x": "m",
    "human_y": "m",
    "human_theta": "rad",
    "true_stubbornness_v": "1",
    "true_stubbornness_omega": "1",
    "true_v": "m/s",
    "true_omega": "rad/s",
    "est_stubbornness_v": "1",
    "est_stubbornness_omega": "1",
    "smoothed_stubbornness_v": "1",
    "smoothed_stubbornness_omega": "1",
    "est_v": "m/s",
    "est_omega": "rad/s",
    "wish_v": "m/s",
    "wish_omega": "rad/s",
    "interaction": "1",
    "interaction_smoothed": "1",
    "utility_loss": "1",
    "target_utility": "1",
    "negotiation": "1",
    "clearance": "m",
}
"""Every trace column and its unit, in the order of the file.

Row k describes control step k: the state at its end, the decisions in force during it, and
what was measured averaged over it. `fx` and `fy` are the measured force in base axes,
`sensor_...` the whole reading in the sensor's axes, about its origin.
"""

_ADDED = frozenset(name for name in UNITS if name.startswith("sensor_"))
"""Columns that files written before there were such do not have."""


class Trace:
    """One row a control step, one column a quantity of `UNITS`.

    Parameters
    ----------
    capacity : int
        Number of rows to make room for at first.
    """

    def __init__(self, capacity: int = 1024) -> None:
        self._rows = np.empty((capacity, len(UNITS)))
        self._count = 0

    def append(self, row: tuple[float, ...]) -> None:
        """Add a row, values in the order of `UNITS`."""
        if self._count == len(self._rows):
            self._rows = np.concatenate((self._rows, np.empty_like(self._rows)))
        self._rows[self._count] = row
        self._count += 1

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, column: str) -> Array:
        """Return a column, shape (rows,)."""
        return self._rows[: self._count, list(UNITS).index(column)]

    def columns(self) -> dict[str, Array]:
        """Return every column by name, each of shape (rows,)."""
        return {name: self._rows[: self._count, i] for i, name in enumerate(UNITS)}

    @property
    def values(self) -> Array:
        """All rows, shape (rows, columns)."""
        return self._rows[: self._count]

    def write(self, file: Path) -> None:
        """Write a Parquet file whose fields carry their unit as metadata ``unit``."""
        import pyarrow as pa
        import pyarrow.parquet as pq

        schema = pa.schema(
            [
                pa.field(
                    name,
                    pa.int64() if name == "negotiation" else pa.float64(),
                    metadata={"unit": unit},
                )
                for name, unit in UNITS.items()
            ]
        )
        arrays = [
            pa.array(np.nan_to_num(column).astype(np.int64) if name == "negotiation" else column)
            for name, column in self.columns().items()
        ]
        pq.write_table(pa.Table.from_arrays(arrays, schema=schema), file)

    @classmethod
    def read(cls, file: Path) -> Trace:
        """Read what `write` wrote; a file from before torque was measured has NaN for ``sensor_``.

        Raises
        ------
        InputError
            If another column is missing.
        """
        import pyarrow.parquet as pq

        table = pq.read_table(file)
        missing = [name for name in UNITS if name not in {*table.column_names, *_ADDED}]
        if missing:
            raise InputError(f"{file}: not a trace: it has no column {', '.join(missing)}")
        trace = cls(max(1, table.num_rows))
        for i, name in enumerate(UNITS):
            known = name in table.column_names
            trace._rows[:, i] = table.column(name).to_numpy() if known else np.nan
        trace._count = table.num_rows
        return trace
