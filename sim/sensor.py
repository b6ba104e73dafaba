"""Force-torque sensor on the handle: what the measured reaction becomes before anyone reads it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .errors import InputError
from .motion import Array
from .sensor_filter import LowPass, Offset, noise_deviation
from .sensor_parameters import SensorParameters

__all__ = ["ForceSensor", "Reading", "SensorParameters"]

TARE_TIME = 0.5
"""Time for which the unloaded sensor is averaged at the start of an episode, s."""


class Reading(NamedTuple):
    """What the sensor reports for a block of samples.

    Attributes
    ----------
    force : ndarray, shape (n, channels)
        N, oldest sample first.
    valid : ndarray of bool, shape (n,)
        False where the latest conversion was lost and an older one is read again.
    saturated : ndarray of bool, shape (n,)
        True where a channel was at the end of its range.
    """

    force: Array
    valid: NDArray[np.bool_]
    saturated: NDArray[np.bool_]


class ForceSensor:
    """Turns true forces into readings, block by block, with memory in between.

    Parameters
    ----------
    parameters : SensorParameters
    sample_rate : int
        Rate of the samples that come in and go out, Hz.
    channels : int
        Number of channels.

    Raises
    ------
    InputError
        If a parameter is given for another number of channels.
    """

    def __init__(
        self, parameters: SensorParameters, sample_rate: int = 240, channels: int = 2
    ) -> None:
        p = self._parameters = parameters
        self._exact = p == SensorParameters()
        self._coupling = _coupling(p.cross_talk, channels)
        self._low_pass = LowPass.below_nyquist(p.low_pass, sample_rate, channels)
        self._offset = Offset(
            _per_channel("bias", p.bias, channels),
            _per_channel("drift", p.drift, channels) / (3600.0 * sample_rate),
            noise_deviation(
                _per_channel("noise_density", p.noise_density, channels), p.low_pass, sample_rate
            ),
            self._low_pass,
        )
        self._tare_samples = round(TARE_TIME * sample_rate)
        self._delay = round(p.latency * sample_rate)
        self._ages = _ages(p.rate, sample_rate)
        self._held = self._delay + int(self._ages.max())
        """How many samples back a reading may reach."""
        self._square = p.range**2
        self._channels = channels
        self._sources: dict[tuple[int, int], NDArray[np.int_]] = {}
        self._zeros: dict[int, Array] = {}
        self._uneventful: dict[int, tuple[NDArray[np.bool_], NDArray[np.bool_]]] = {}
        self.reset(np.random.default_rng(0))

    def reset(self, rng: np.random.Generator) -> None:
        """Start over, unloaded, with a generator of its own; tare if asked for."""
        noise_rng, self._loss_rng = rng.spawn(2)
        if self._exact:
            return
        p = self._parameters
        if self._low_pass is not None:
            self._low_pass.reset()
        self._offset.reset(noise_rng)
        # Samples are counted from the start of the tare: what an unloaded sensor reads then
        # settles the filter, fills the delay and gives the zero.
        unloaded = max(self._tare_samples, self._held, 1)
        self._count = 0
        self._saturated: list[int] = []
        self._zero, self._zeros = np.zeros(self._channels), {}
        before = self._convert(np.zeros((unloaded, self._channels)))
        if p.tare:
            self._zero = before[-self._tare_samples :].mean(axis=0)
            if p.resolution > 0.0:
                self._zero = _quantise(self._zero, p.resolution)
            self._zeros = {}
            before -= self._zero
        self._history = before[unloaded - self._held :]
        self._last, self._last_saturated = before[-1], False
        self._lost: list[int] = []
        self._next_loss = self._count + self._gap() - 1

    def measure(self, force_on_base: Array) -> Reading:
        """Return the readings for a block of samples.

        Parameters
        ----------
        force_on_base : ndarray, shape (n, channels)
            Force of the human on the base, base axes, N, oldest sample first.

        Returns
        -------
        Reading
            Its force is the very input where the sensor is without faults.
        """
        n = len(force_on_base)
        flags = self._uneventful.get(n)
        if flags is None:
            flags = self._uneventful[n] = np.ones(n, dtype=bool), np.zeros(n, dtype=bool)
            for flag in flags:
                flag.flags.writeable = False
        if self._exact:
            return Reading(force_on_base, *flags)
        first = self._count
        force = self._convert(force_on_base)
        while self._next_loss < self._count:
            self._lost.append(self._next_loss)
            self._next_loss += self._gap()
        if self._held:
            force = np.concatenate((self._history, force))
            self._history = force[n:]
        source = self._source((first - self._delay) % len(self._ages), n)
        if self._lost or self._saturated:
            return self._eventful(force, source, first - self._held)
        if self._held:
            force = force.take(source, axis=0)
        self._last, self._last_saturated = force[-1], False
        return Reading(force, *flags)

    def _convert(self, force: Array) -> Array:
        """Return what the converter puts out at every sample, a fresh array."""
        p = self._parameters
        n = len(force)
        value = force.dot(self._coupling) if self._coupling is not None else force
        if self._low_pass is not None:
            value = self._low_pass(value)
        value = value + self._offset.take(n)
        # No sample is beyond the range if the sum of their squares is not.
        if self._square < math.inf and np.vdot(value, value) > self._square:
            beyond = (np.abs(value) > p.range).any(axis=1)
            self._saturated += (np.flatnonzero(beyond) + self._count).tolist()
            np.clip(value, -p.range, p.range, out=value)
        self._count += n
        if p.resolution > 0.0:
            value = _quantise(value, p.resolution)
        if p.tare:
            value -= self._zero_rows(n)
        return value

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

    def _eventful(self, force: Array, source: NDArray[np.int_], first: int) -> Reading:
        """Return a block with lost or saturated samples; ``first`` counts the first row."""
        missing = _among(source + first, self._lost)
        newest = np.maximum.accumulate(np.where(missing, -1, source))
        arrived = force[newest]
        saturated = _among(newest + first, self._saturated)
        none_yet = newest < 0
        if none_yet[0]:
            arrived[none_yet], saturated[none_yet] = self._last, self._last_saturated
        oldest = self._count - self._held
        self._lost = [k for k in self._lost if k >= oldest]
        self._saturated = [k for k in self._saturated if k >= oldest]
        self._last, self._last_saturated = arrived[-1], bool(saturated[-1])
        return Reading(arrived, ~missing, saturated)


def _among(samples: NDArray[np.int_], few: list[int]) -> NDArray[np.bool_]:
    """Return which samples are among a few (`numpy.isin` takes 30 us to sort a dozen)."""
    found = np.zeros(len(samples), dtype=bool)
    for sample in few:
        found |= samples == sample
    return found


def _quantise(value: Array, step: float) -> Array:
    """Round to whole steps, in place."""
    value /= step
    np.rint(value, out=value)
    value *= step
    return value


def _per_channel(name: str, value: float | tuple[float, ...], channels: int) -> Array:
    array = np.asarray(value, dtype=float)
    if array.ndim and array.shape != (channels,):
        raise InputError(
            f"sensor.{name} has {array.size} entries; give one number, or {channels}, one a channel"
        )
    return np.broadcast_to(array, (channels,)).copy()


def _coupling(cross_talk: float | tuple[tuple[float, ...], ...], channels: int) -> Array | None:
    """Return what a row of forces is multiplied with, or None where nothing changes."""
    shares = np.asarray(cross_talk, dtype=float)
    if not shares.ndim:
        shares = float(cross_talk) * (1.0 - np.eye(channels))  # type: ignore[arg-type]
    if shares.shape != (channels, channels):
        raise InputError(
            f"sensor.cross_talk has shape {shares.shape}; give one number, or {channels} rows "
            f"of {channels}"
        )
    return np.eye(channels) + shares.T if shares.any() else None


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
