"""Force-torque sensor on the handle: what the measured reaction becomes before anyone reads it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .errors import InputError
from .motion import Array
from .sensor_channels import CHANNELS, FORCES, TORQUES, channels, coupling
from .sensor_filter import LowPass, Offset, noise_deviation
from .sensor_parameters import SensorParameters
from .wrench import AT_HANDLE, SensorMount, in_base_frame, in_sensor_frame

__all__ = ["ForceSensor", "Reading", "SensorParameters"]

Flags = NDArray[np.bool_]
TARE_TIME = 0.5
"""Time for which the sensor, nobody pushing, is averaged before an episode starts, s."""


class Reading(NamedTuple):
    """What the sensor reports for a block of samples.

    Attributes
    ----------
    force : ndarray, shape (n, 2)
        Planar force in base axes that follows from the wrench and the sensor's known mount, N,
        oldest sample first.
    wrench : ndarray, shape (n, 6)
        Force (N) and torque about the sensor's origin (N m), sensor axes: what the sensor reads.
    valid : ndarray of bool, shape (n,)
        False where the latest conversion was lost and an older one is read again.
    saturated : ndarray of bool, shape (n,)
        True where a channel was at the end of its range.
    """

    force: Array
    wrench: Array
    valid: Flags
    saturated: Flags


class ForceSensor:
    """Turns true forces and torques into readings, block by block, with memory in between.

    Parameters
    ----------
    parameters : SensorParameters
    sample_rate : int
        Rate of the samples that come in and go out, Hz.

    Raises
    ------
    InputError
        If a list or a matrix is not made for six channels.
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
        self._delay = round(p.latency * sample_rate)
        self._ages = _ages(p.rate, sample_rate)
        self._held = self._delay + int(self._ages.max())
        """How many samples back a reading may reach."""
        self._sources: dict[tuple[int, int], NDArray[np.int_]] = {}
        self._zeros: dict[int, Array] = {}
        self._uneventful: dict[int, tuple[Flags, Flags]] = {}
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
        noise_rng, self._loss_rng = rng.spawn(2)
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
        before_start = max(self._tare_samples, self._held, 1)
        self._count = 0
        self._saturated: list[int] = []
        self._zero, self._zeros = np.zeros(CHANNELS), {}
        before = self._convert(np.tile(standing, (before_start, 1)))
        if p.tare:
            self._zero = before[-self._tare_samples :].mean(axis=0)
            self._quantise(self._zero)
            self._zeros = {}
            before -= self._zero
        self._history = before[before_start - self._held :]
        self._last, self._last_saturated = before[-1], False
        self._lost: list[int] = []
        self._next_loss = self._count + self._gap() - 1

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
            f"{self._range[worst] / abs(read[worst]):.0%} of that (coupling.mass)"
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
        n = len(wrench_on_base)
        flags = self._uneventful.get(n)
        if flags is None:
            flags = self._uneventful[n] = np.ones(n, dtype=bool), np.zeros(n, dtype=bool)
            for flag in flags:
                flag.flags.writeable = False
        wrench = in_sensor_frame(wrench_on_base, mount)
        if self._exact:
            return Reading(wrench_on_base[:, :2], wrench, *flags)
        wrench, valid, saturated = self._sampled(wrench, *flags)
        return Reading(in_base_frame(wrench, mount)[:, :2], wrench, valid, saturated)

    def _sampled(self, wrench: Array, valid: Flags, saturated: Flags) -> tuple[Array, Flags, Flags]:
        """Return what has arrived by each sample; the flags as given if all is well."""
        n, first = len(wrench), self._count
        wrench = self._convert(wrench)
        while self._next_loss < self._count:
            self._lost.append(self._next_loss)
            self._next_loss += self._gap()
        if self._held:
            wrench = np.concatenate((self._history, wrench))
            self._history = wrench[n:]
        source = self._source((first - self._delay) % len(self._ages), n)
        if self._lost or self._saturated:
            return self._eventful(wrench, source, first - self._held)
        if self._held:
            wrench = wrench.take(source, axis=0)
        self._last, self._last_saturated = wrench[-1], False
        return wrench, valid, saturated

    def _convert(self, wrench: Array) -> Array:
        """Return what the converter puts out at every sample, a fresh array."""
        n = len(wrench)
        value = wrench.dot(self._coupling) if self._coupling is not None else wrench
        if self._low_pass is not None:
            value = self._low_pass(value)
        value = value + self._offset.take(n)
        if self._limited:
            # No sample is beyond its range if the sum of their squares, in ranges, is not.
            shares = value / self._range
            if np.vdot(shares, shares) > 1.0:
                beyond = (np.abs(shares) > 1.0).any(axis=1)
                self._saturated += (np.flatnonzero(beyond) + self._count).tolist()
                np.clip(value, -self._range, self._range, out=value)
        self._count += n
        self._quantise(value)
        if self._parameters.tare:
            value -= self._zero_rows(n)
        return value

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

    def _gap(self) -> int:
        """Return after how many samples the next one is lost."""
        rate = self._parameters.drop_rate
        return int(self._loss_rng.geometric(rate)) if rate > 0.0 else 1 << 60

    def _source(self, phase: int, n: int) -> NDArray[np.int_]:
        """Return which row of history and block has arrived by each sample of the block."""
        source = self._sources.get((phase, n))
        if source is None:
            ages = self._ages[(phase + np.arange(n)) % len(self._ages)]
            source = self._sources[phase, n] = self._held - self._delay + np.arange(n) - ages
        return source

    def _eventful(
        self, wrench: Array, source: NDArray[np.int_], first: int
    ) -> tuple[Array, Flags, Flags]:
        """Return a block with lost or saturated samples; ``first`` counts the first row."""
        missing = _among(source + first, self._lost)
        newest = np.maximum.accumulate(np.where(missing, -1, source))
        arrived = wrench[newest]
        saturated = _among(newest + first, self._saturated)
        none_yet = newest < 0
        if none_yet[0]:
            arrived[none_yet], saturated[none_yet] = self._last, self._last_saturated
        oldest = self._count - self._held
        self._lost = [k for k in self._lost if k >= oldest]
        self._saturated = [k for k in self._saturated if k >= oldest]
        self._last, self._last_saturated = arrived[-1], bool(saturated[-1])
        return arrived, ~missing, saturated


def _among(samples: NDArray[np.int_], few: list[int]) -> Flags:
    """Return which samples are among a few (`numpy.isin` takes 30 us to sort a dozen)."""
    found = np.zeros(len(samples), dtype=bool)
    for sample in few:
        found |= samples == sample
    return found


def _converters(resolution: Array) -> list[tuple[slice, Array]]:
    """Return which channels are rounded, and to which steps."""
    if resolution.all():
        return [(slice(0, CHANNELS), resolution)]
    return [(part, resolution[part]) for part in (FORCES, TORQUES) if resolution[part].all()]


def _ages(rate: float, sample_rate: int) -> NDArray[np.int_]:
    """Return how many samples ago the last conversion was, over one period of the pattern."""
    if not 0.0 < rate < sample_rate:
        return np.zeros(1, dtype=int)
    conversions = max(1, round(rate * 1000))  # a period of whole samples, to 1 mHz
    period = sample_rate * 1000 // math.gcd(conversions, sample_rate * 1000)
    sample = np.arange(period)
    latest = sample * conversions // (sample_rate * 1000)
    taken = -(-latest * sample_rate * 1000 // conversions)
    return np.asarray(sample - taken)
