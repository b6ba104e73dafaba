"""Force-torque sensor on the handle: what the measured reaction becomes before anyone reads it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..basics.errors import InputError
from ..basics.motion import Array
from .channels import CHANNELS, FORCES, TORQUES, channels, coupling
from .filter import LowPass, Offset, noise_deviation
from .parameters import SensorParameters
from .transmission import Flags, Transmission, all_well
from .wrench import AT_HANDLE, SensorMount, in_base_frame, in_sensor_frame

__all__ = ["ForceSensor", "Reading", "SensorParameters"]

TARE_TIME = 0.5
"""Time for which the sensor, nobody pushing, is averaged before an episode starts, s."""


class Reading(NamedTuple):
    """What the sensor reports for a block of samples.

    Attributes
    ----------
    wrench_on_base : ndarray, shape (n, 6)
        Force (N) and torque about the handle (N m), base axes, that follow from what the sensor
        reads and its known mount; oldest sample first.
    wrench : ndarray, shape (n, 6)
        Force (N) and torque about the sensor's origin (N m), sensor axes: what the sensor reads.
    valid : ndarray of bool, shape (n,)
        False where the latest conversion was lost and an older one is read again.
    saturated : ndarray of bool, shape (n,)
        True where a channel was at the end of its range.
    """

    wrench_on_base: Array
    wrench: Array
    valid: Flags
    saturated: Flags

    @property
    def force(self) -> Array:
        """The planar force on the base, base axes, N, shape (n, 2)."""
        return self.wrench_on_base[:, :2]


class ForceSensor:
    """Turns true forces and torques into readings, block by block, with memory in between.

    Parameters
    ----------
    parameters : SensorParameters
    sample_rate : int
        Rate of the samples that come in and go out, Hz.
    """

    def __init__(self, parameters: SensorParameters, sample_rate: int = 240) -> None:
        p = self._parameters = parameters
        self._exact = p == SensorParameters()
        self._coupling = coupling(p)
        self._low_pass = LowPass.below_nyquist(p.low_pass, sample_rate, CHANNELS)
        self._offset = Offset(
            channels(p, "bias"),
            channels(p, "drift") / (3600.0 * sample_rate),
            noise_deviation(channels(p, "noise_density"), p.low_pass, sample_rate),
            self._low_pass,
        )
        self._range = channels(p, "range")
        self._limited = min(p.range, p.torque_range) < math.inf
        self._converters = _converters(channels(p, "resolution"))
        self._tare_samples = round(TARE_TIME * sample_rate)
        self._transmission = Transmission(p.rate, p.latency, p.drop_rate, sample_rate)
        self._zeros: dict[int, Array] = {}
        self.reset(np.random.default_rng(0))

    def reset(
        self,
        rng: np.random.Generator,
        standing_wrench: Array | None = None,
        mount: SensorMount = AT_HANDLE,
    ) -> None:
        """Start over with a generator of its own; tare, if asked for, with what hangs on it.

        Parameters
        ----------
        rng : numpy.random.Generator
        standing_wrench : ndarray, shape (6,), optional
            Force (N) and torque about the handle (N m) on the base at rest, before anybody
            pushes, base axes: of a load that is clamped on for good. None is an unloaded sensor.
        mount : SensorMount
            Where the sensor sits.

        Raises
        ------
        InputError
            If that alone is beyond the range of a channel.
        """
        noise_rng, loss_rng = rng.spawn(2)
        if self._exact:
            return
        p = self._parameters
        standing = np.zeros(CHANNELS)
        if standing_wrench is not None and standing_wrench.any():
            standing = in_sensor_frame(standing_wrench, mount)
            self._require_range(standing)
        if self._low_pass is not None:
            mixed = standing.dot(self._coupling) if self._coupling is not None else standing
            self._low_pass.reset(mixed)
        self._offset.reset(noise_rng)
        # Samples are counted from the start of the tare: what the sensor reads then, nobody
        # pushing, fills the delay and gives the zero.
        before_start = max(self._tare_samples, self._transmission.reach, 1)
        self._zero, self._zeros = np.zeros(CHANNELS), {}
        before, saturated = self._convert(np.tile(standing, (before_start, 1)))
        if p.tare:
            self._zero = before[-self._tare_samples :].mean(axis=0)
            self._quantise(self._zero)
            self._zeros = {}
            before -= self._zero
        self._transmission.reset(loss_rng, before, saturated)

    def _require_range(self, standing: Array) -> None:
        """Refuse a load at rest, sensor axes, that leaves a channel nothing to read with."""
        read = channels(self._parameters, "bias")
        read += standing.dot(self._coupling) if self._coupling is not None else standing
        worst = int((np.abs(read) / self._range).argmax())
        if abs(read[worst]) <= self._range[worst]:
            return
        name, unit, axis = (
            ("range", "N", "along ") if worst < 3 else ("torque_range", "N m", "about ")
        )
        axis += "xyz"[worst % 3]
        raise InputError(
            f"sensor.{name} = {self._range[worst]:g} {unit}: what is clamped on at rest already "
            f"reads {read[worst]:.3g} {unit} {axis}, bias included; give a range well above "
            f"{abs(read[worst]):.3g} {unit}, or let it carry well below "
            f"{self._range[worst] / abs(read[worst]):.0%} of that (coupling.mass)",
            ("sensor", name),
        )

    def measure(self, wrench_on_base: Array, mount: SensorMount = AT_HANDLE) -> Reading:
        """Return the readings for a block of samples.

        Parameters
        ----------
        wrench_on_base : ndarray, shape (n, 6)
            Force (N) and torque about the handle (N m) of the human on the base, base axes,
            oldest sample first.
        mount : SensorMount
            Where the sensor sits.

        Returns
        -------
        Reading
            Its force is the very input where the sensor is without faults.
        """
        wrench = in_sensor_frame(wrench_on_base, mount)
        if self._exact:
            return Reading(wrench_on_base, wrench, *all_well(len(wrench)))
        wrench, valid, saturated = self._transmission(*self._convert(wrench))
        return Reading(in_base_frame(wrench, mount), wrench, valid, saturated)

    def _convert(self, wrench: Array) -> tuple[Array, list[int]]:
        """Return what the converter puts out, a fresh array, and its rows that are saturated."""
        n = len(wrench)
        value = wrench.dot(self._coupling) if self._coupling is not None else wrench
        if self._low_pass is not None:
            value = self._low_pass(value)
        value = value + self._offset.take(n)
        saturated: list[int] = []
        if self._limited:
            # No sample is beyond its range if the sum of their squares, in ranges, is not.
            shares = value / self._range
            if np.vdot(shares, shares) > 1.0:
                saturated = np.flatnonzero((np.abs(shares) > 1.0).any(axis=1)).tolist()
                np.clip(value, -self._range, self._range, out=value)
        self._quantise(value)
        if self._parameters.tare:
            value -= self._zero_rows(n)
        return value, saturated

    def _quantise(self, value: Array) -> None:
        """Round every channel to whole steps, in place."""
        for part, step in self._converters:
            steps = value[..., part]
            steps /= step
            np.rint(steps, out=steps)
            steps *= step

    def _zero_rows(self, n: int) -> Array:
        """Return the tare once a sample: rows added to rows take half the time of broadcasting."""
        rows = self._zeros.get(n)
        if rows is None:
            rows = self._zeros[n] = np.tile(self._zero, (n, 1))
        return rows


def _converters(resolution: Array) -> list[tuple[slice, Array]]:
    """Return which channels are rounded, and to which steps."""
    if resolution.all():
        return [(slice(0, CHANNELS), resolution)]
    return [(part, resolution[part]) for part in (FORCES, TORQUES) if resolution[part].all()]
