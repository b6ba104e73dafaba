"""What a sensor does to a signal and adds to it: a low-pass; bias, drift and noise.

`scipy.signal` is slow to import, and imported where there is a low-pass.
"""

from __future__ import annotations

import math

import numpy as np

from ..basics.motion import Array

ORDER = 2
CHUNK = 960
"""Samples of offset that are made at once."""
LONGEST_BLOCK = 64
"""Samples that are filtered with one matrix product; longer blocks are cut."""


def noise_deviation(density: Array, low_pass: float, sample_rate: float) -> Array:
    """Return the standard deviation of the noise samples that go into the low-pass.

    Parameters
    ----------
    density : ndarray, shape (channels,)
        One-sided density, N/sqrt(Hz) or N m/sqrt(Hz).
    low_pass : float
        -3 dB frequency, Hz; 0 is none.
    sample_rate : float
        Hz.

    Returns
    -------
    ndarray, shape (channels,)
        N: sqrt(sample_rate / 2) times the density for a low-pass that the samples can carry, and
        without one. A low-pass above that leaves its noise bandwidth, f_c (pi / 4) / sin(pi / 4)
        for the second-order Butterworth, which sampling then folds down.
    """
    nyquist = sample_rate / 2.0
    bandwidth = nyquist
    if low_pass >= nyquist:
        turn = math.pi / (2.0 * ORDER)
        bandwidth = low_pass * turn / math.sin(turn)
    return np.asarray(density * math.sqrt(bandwidth))


class LowPass:
    """Second-order Butterworth over blocks of samples, its state kept in between.

    Output and next state are linear in state and input, so a block is one product with a matrix,
    found by filtering unit inputs once: 2 us for 12 samples, where `scipy.signal.sosfilt` takes
    tens to check its arguments.

    Parameters
    ----------
    frequency : float
        -3 dB frequency, Hz, below half the sample rate.
    sample_rate : float
        Hz.
    channels : int
    """

    def __init__(self, frequency: float, sample_rate: float, channels: int) -> None:
        from scipy import signal

        self.b, self.a = signal.butter(ORDER, frequency, fs=sample_rate)
        self._channels = channels
        self._blocks: dict[int, tuple[Array, Array]] = {}
        self.reset()

    @classmethod
    def below_nyquist(cls, frequency: float, sample_rate: float, channels: int) -> LowPass | None:
        """Return the low-pass, or None where there is none that the samples can carry."""
        return cls(frequency, sample_rate, channels) if 0.0 < frequency < sample_rate / 2 else None

    def reset(self, level: Array | None = None) -> None:
        """Come to rest at what has been coming in for long, shape (channels,), or else at 0."""
        self._state = np.zeros((ORDER, self._channels))
        if level is not None:
            from scipy import signal

            self._state += signal.lfilter_zi(self.b, self.a)[:, None] * level

    def __call__(self, samples: Array) -> Array:
        """Return the filtered samples, a fresh array, shape (n, channels)."""
        n = len(samples)
        if n > LONGEST_BLOCK:
            parts = range(0, n, LONGEST_BLOCK)
            return np.concatenate([self(samples[i : i + LONGEST_BLOCK]) for i in parts])
        found = self._blocks.get(n)
        if found is None:
            found = self._blocks[n] = self._block(n), np.empty((ORDER + n, self._channels))
        block, rows = found
        rows[:ORDER] = self._state
        rows[ORDER:] = samples
        both: Array = block.dot(rows)
        self._state = both[n:]
        return both[:n]

    def _block(self, n: int) -> Array:
        """Return the matrix from state and n inputs to n outputs and the next state."""
        from scipy import signal

        units = np.eye(ORDER + n)
        out, state = signal.lfilter(self.b, self.a, units[ORDER:], axis=0, zi=units[:ORDER])
        return np.concatenate((out, state))


class Offset:
    """What a sensor reads on its own: bias, drift, and noise behind the low-pass.

    Made for a second or more at once, since arrays of a dozen samples cost as much as ones of a
    thousand. The low-pass is linear, and leaves the bias and the slow drift as they are.

    Parameters
    ----------
    bias : ndarray, shape (channels,)
        N.
    slope : ndarray, shape (channels,)
        Drift, N a sample.
    deviation : ndarray, shape (channels,)
        Standard deviation of the noise ahead of the low-pass, N.
    low_pass : LowPass or None
        Only its coefficients are used.
    """

    def __init__(
        self, bias: Array, slope: Array, deviation: Array, low_pass: LowPass | None
    ) -> None:
        self._bias, self._slope, self._deviation = bias, slope, deviation
        self._low_pass = low_pass
        self.reset(np.random.default_rng(0))

    def reset(self, rng: np.random.Generator) -> None:
        """Start over with a generator of its own."""
        self._rng = rng
        self._state = np.zeros((ORDER, len(self._bias)))
        self._made = 0
        self._ready = np.empty((0, len(self._bias)))

    def take(self, n: int) -> Array:
        """Return the next n samples, N, shape (n, channels)."""
        if len(self._ready) < n:
            self._ready = np.concatenate((self._ready, self._make(max(n, CHUNK))))
        taken, self._ready = self._ready[:n], self._ready[n:]
        return taken

    def _make(self, n: int) -> Array:
        noise = self._rng.standard_normal((n, len(self._bias))) * self._deviation
        if self._low_pass is not None:
            from scipy import signal

            noise, self._state = signal.lfilter(
                self._low_pass.b, self._low_pass.a, noise, axis=0, zi=self._state
            )
        sample = np.arange(self._made + 1, self._made + n + 1)[:, None]
        self._made += n
        return np.asarray(noise + self._bias + sample * self._slope)
