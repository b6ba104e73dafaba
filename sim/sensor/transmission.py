"""From a sensor's converter to who reads it: its own rate, latency, and samples that get lost."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

from ..basics.motion import Array

Flags = NDArray[np.bool_]
NEVER = 1 << 60
"""Number of a sample that no run reaches."""


@cache
def all_well(n: int) -> tuple[Flags, Flags]:
    """Return the flags, valid and saturated, of n samples that are well: not to be changed."""
    flags = np.ones(n, dtype=bool), np.zeros(n, dtype=bool)
    for flag in flags:
        flag.flags.writeable = False
    return flags


class Transmission:
    """Turns what the converter puts out at every sample into what has arrived by then.

    Parameters
    ----------
    rate : float
        Of conversions, Hz; 0, or the sample rate and above, is one a sample.
    latency : float
        From a conversion to its arrival, s.
    drop_rate : float
        Share of samples that are lost.
    sample_rate : int
        Hz.
    """

    def __init__(self, rate: float, latency: float, drop_rate: float, sample_rate: int) -> None:
        self._drop_rate = drop_rate
        self._delay = round(latency * sample_rate)
        self._ages = _ages(rate, sample_rate)
        self.reach = self._delay + int(self._ages.max())
        """How many samples back a reading may reach."""
        self._sources: dict[tuple[int, int], NDArray[np.int_]] = {}

    def reset(self, rng: np.random.Generator, before: Array, saturated: list[int]) -> None:
        """Start over.

        Parameters
        ----------
        rng : numpy.random.Generator
            Chooses what is lost.
        before : ndarray, shape (n, channels)
            What the converter put out before the start, n at least `reach` and 1.
        saturated : list of int
            Rows of it that were at the end of their range.
        """
        self._rng = rng
        self._count = len(before)
        self._history = before[self._count - self.reach :]
        self._last, self._last_saturated = before[-1], False
        self._saturated = list(saturated)
        self._lost: list[int] = []
        self._next_loss = self._count + self._gap() - 1

    def __call__(self, converted: Array, saturated: list[int]) -> tuple[Array, Flags, Flags]:
        """Return what has arrived by each sample of a block, and whether it is new, and saturated.

        Parameters
        ----------
        converted : ndarray, shape (n, channels)
        saturated : list of int
            Rows of it that are at the end of their range.
        """
        n, first = len(converted), self._count
        self._count += n
        if saturated:
            self._saturated += [first + row for row in saturated]
        while self._next_loss < self._count:
            self._lost.append(self._next_loss)
            self._next_loss += self._gap()
        if self.reach:
            converted = np.concatenate((self._history, converted))
            self._history = converted[n:]
        source = self._source((first - self._delay) % len(self._ages), n)
        if self._lost or self._saturated:
            return self._eventful(converted, source, first - self.reach)
        if self.reach:
            converted = converted.take(source, axis=0)
        self._last, self._last_saturated = converted[-1], False
        return converted, *all_well(n)

    def _gap(self) -> int:
        """Return after how many samples the next one is lost."""
        return int(self._rng.geometric(self._drop_rate)) if self._drop_rate > 0.0 else NEVER

    def _source(self, phase: int, n: int) -> NDArray[np.int_]:
        """Return which row of history and block has arrived by each sample of the block."""
        source = self._sources.get((phase, n))
        if source is None:
            ages = self._ages[(phase + np.arange(n)) % len(self._ages)]
            source = self._sources[phase, n] = self.reach - self._delay + np.arange(n) - ages
        return source

    def _eventful(
        self, converted: Array, source: NDArray[np.int_], first: int
    ) -> tuple[Array, Flags, Flags]:
        """Return a block with lost or saturated samples; ``first`` counts the first row."""
        missing = _among(source + first, self._lost)
        newest = np.maximum.accumulate(np.where(missing, -1, source))
        arrived = converted[newest]
        saturated = _among(newest + first, self._saturated)
        none_yet = newest < 0
        if none_yet[0]:
            arrived[none_yet], saturated[none_yet] = self._last, self._last_saturated
        oldest = self._count - self.reach
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


def _ages(rate: float, sample_rate: int) -> NDArray[np.int_]:
    """Return how many samples ago the last conversion was, over one period of the pattern."""
    if not 0.0 < rate < sample_rate:
        return np.zeros(1, dtype=int)
    conversions = round(rate * 1000)  # a period of whole samples, to 1 mHz
    period = sample_rate * 1000 // math.gcd(conversions, sample_rate * 1000)
    sample = np.arange(period)
    latest = sample * conversions // (sample_rate * 1000)
    taken = -(-latest * sample_rate * 1000 // conversions)
    return np.asarray(sample - taken)
