"""A human whose force somebody measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar, Literal

import numpy as np

from cowalk.sim.basics.file_names import FileName
from cowalk.sim.basics.lists import require_pairs
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import (
    Range,
    require,
    require_choices,
    require_instance,
    require_ranges,
    require_text,
)

from ...basics.protocols import Truth
from ..laws.demand import FORCE_MAX, Pair, strength, unknown
from .recording import Columns, read_recording
from .resampling import resample
from .sensor import RecordingSensor
from .units import Units

RANGES: dict[str, Range] = {"start": (0.0, 86400.0, "s"), "scale": (-1000.0, 1000.0, "")}
"""Inferred."""
CHOICES = {
    "gaps": ("refuse", "hold"),
    "resample": ("mean", "linear", "hold"),
    "at_end": ("loop", "stop"),
}


@dataclass(kw_only=True)
class RecordedHuman:
    """Exerts the force of a recording, whatever the base does.

    A recording does not tell what the person wanted: wish and stubbornness are NaN. Insistence,
    the share of their strength, is known.

    Parameters
    ----------
    file : FileName
        CSV, Parquet or NumPy (.npy, .npz) file.
    columns : Columns
        Which of its columns hold time and force.
    rate : float, optional
        Rows a second, Hz, where no column holds the time.
    rows : mapping of str to str
        What must stand in other columns of a row, see `read_recording`.
    sensor : RecordingSensor
        How it was mounted, and what it read at rest.
    units : Units
    gaps : {"refuse", "hold"}
        What becomes of a file in which rows are missing: it is refused, or the last force is
        held until the next row, see `read_recording`.
    resample : {"mean", "linear", "hold"}
        How samples become one force a control period, see `resample`.
    at_end : {"loop", "stop"}
        Start over, or let go, when the recording ends.
    start : float
        Time at which the recording begins to play, s; 0 N before.
    scale : float
        Factor on the force, on top of the sensor's signs.
    force_max : (float, float)
        Largest force forward and sideways of the person, N: what insistence refers to.

    Raises
    ------
    InputError
        If the recording is not right (see `read_recording`), or a parameter is outside the
        range stated.
    """

    closed_loop: ClassVar[bool] = False

    file: FileName
    columns: Columns = field(default_factory=Columns)
    rate: float | None = None
    rows: Mapping[str, str] = field(default_factory=dict)
    sensor: RecordingSensor = field(default_factory=RecordingSensor)
    units: Units = field(default_factory=Units)
    gaps: Literal["refuse", "hold"] = "refuse"
    resample: Literal["mean", "linear", "hold"] = "mean"
    at_end: Literal["loop", "stop"] = "loop"
    start: float = 0.0
    scale: float = 1.0
    force_max: Pair = (7.5, 7.5)

    def __post_init__(self) -> None:
        require_instance("columns", self.columns, Columns)
        require_instance("units", self.units, Units)
        require_instance("sensor", self.sensor, RecordingSensor)
        what = "texts by names of columns are expected"
        require(isinstance(self.rows, Mapping), "rows", self.rows, what)
        for column, value in self.rows.items():
            require_text("rows", column, "the name of a column")
            require_text(("rows", column), value, "the text that stands there")
        require_choices(self, CHOICES)
        require_pairs(self, {"force_max": FORCE_MAX})
        require_ranges(self, RANGES)
        self._time, self._force = read_recording(
            self.file,
            self.columns,
            self.units,
            self.gaps,
            rate=self.rate,
            rows=self.rows,
            sensor=self.sensor,
        )

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Human.reset`."""
        self._period = situation.period
        played = self.scale * resample(self._time, self._force, self._period, self.resample)
        # The last row is silence: before the start, and after the end if it does not loop.
        self._played = np.vstack((played, np.zeros(2)))
        self._strength = strength(self.force_max)
        self._truth = unknown(np.zeros(2), self._strength)

    def act(self, observation: Observation) -> Array:
        """See `Human.act`."""
        silence = len(self._played) - 1
        # Half a period forgives rounding in control times.
        since = (observation["time"][..., 0] - self.start) / self._period + 0.5
        step = np.floor(since).astype(int)
        if self.at_end == "loop":
            row = np.where(step < 0, silence, step % silence)
        else:
            row = np.where((step < 0) | (step >= silence), silence, step)
        force = self._played[row]
        self._truth = unknown(observation["twist"], self._strength)
        return np.asarray(force)

    def truth(self) -> Truth:
        """See `Human.truth`."""
        return self._truth
