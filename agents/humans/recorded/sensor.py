"""What recorded a force: which way its axes point, and what it read when nobody pushed. Pure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.frames import rotation
from cowalk.sim.basics.lists import require_entries
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.validators import Range, require, require_range

Triple = tuple[float, float, float]
ZEROED: Range = (0.0, 3600.0, "s")
"""How long nobody pushed (inferred)."""
ATTITUDE: Range = (-10.0, 10.0, "rad")
"""More than a turn either way (inferred)."""
LEVEL = 1e-9
"""Share of the third force below which a sensor counts as upright."""


@dataclass(frozen=True, kw_only=True)
class RecordingSensor:
    """How a recording's columns of force become forces on the base: zeroed, signed, then turned.

    Parameters
    ----------
    zero : float
        How long nobody pushed at the start, s: the mean force of that time is taken off.
    signs : (x, y, z)
        1 or -1 for each column: -1 where the file has the force of the base on the hand, or
        counts the other way.
    rpy : (roll, pitch, yaw)
        Attitude of the sensor in base axes, fixed-axis angles in rad, as in
        `cowalk.sim.sensor.wrench.SensorMount`; a tilted one needs all three columns.

    Raises
    ------
    InputError
        If a sign is neither, or a number makes no sense.
    """

    zero: float = 0.0
    signs: Triple = (1.0, 1.0, 1.0)
    rpy: Triple = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        require_range("zero", self.zero, ZEROED)
        require_entries(self, ("signs",), 3, (-1.0, 1.0, ""))
        require(set(self.signs) <= {1, -1}, "signs", self.signs, "each must be 1 or -1")
        require_entries(self, ("rpy",), 3, ATTITUDE)


AS_THE_BASE = RecordingSensor()
"""One whose columns are forces on the base, base axes."""


def in_base_axes(time: Array, force: Array, sensor: RecordingSensor) -> Array:
    """Return recorded forces as they act on the base.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s from 0.
    force : ndarray, shape (n, 2) or (n, 3)
        As recorded, N.
    sensor : RecordingSensor

    Returns
    -------
    ndarray, shape (n, 2)
        Forward and to the left, N.

    Raises
    ------
    InputError
        If the recording is shorter than the sensor was at rest, or a third force is missing.
    """
    if sensor.zero > 0.0:
        last = float(time[-1])
        what = f"must be shorter than the recording, {last:g} s"
        require(sensor.zero < last, ("sensor", "zero"), sensor.zero, what, "s")
        force = force - force[time < sensor.zero].mean(axis=0)
    count = force.shape[1]
    turn = rotation(*sensor.rpy)[:2]
    if count < 3 and np.abs(turn[:, 2]).max() > LEVEL:
        what = "sensor.rpy tilts the sensor, so the third force counts: name its column"
        raise InputError(f"columns.fz: {what}", ("columns", "fz"))
    signed = force * np.array(sensor.signs[:count])
    return signed[:, :2] if not any(sensor.rpy) else np.asarray(signed @ turn[:, :count].T)
