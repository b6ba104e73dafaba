"""Means of the samples that arrived: of a block, and sliding along the stream."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.validators import Range, require_ranges

STRIDE = 1.4
"""Two steps at 0.8 m/s, s: a mean over it takes out the sway of a walking human."""
WINDOW: Range = (1e-6, 3600.0, "s")
"""From a single sample to an hour (inferred)."""


def mean_force(force: Array, valid: Array | None = None) -> Array:
    """Return the mean of the samples that arrived.

    Parameters
    ----------
    force : ndarray, shape (..., samples, 2)
        N.
    valid : ndarray, shape (..., samples), optional
        1 or 0, as ``force_valid`` of an observation; without it, or where no sample arrived, all
        samples count.

    Returns
    -------
    ndarray, shape (..., 2)
    """
    if valid is None or valid.all():
        return np.asarray(force.mean(axis=-2))
    weight = np.where(valid.any(axis=-1, keepdims=True), valid, 1.0)[..., None]
    return np.asarray((force * weight).sum(axis=-2) / weight.sum(axis=-2))


@dataclass
class SlidingMean:
    """Replaces every sample by the mean of those that arrived in a window up to it.

    Parameters
    ----------
    window : float
        Length of the window, s. Until so much has been heard, the mean is over what has been.

    Raises
    ------
    InputError
        If the window is outside of `WINDOW`.
    """

    window: float = STRIDE

    def __post_init__(self) -> None:
        require_ranges(self, {"window": WINDOW})

    @property
    def delay(self) -> float:
        """See `FrontEnd.delay`: half of the window, as it fits whole samples."""
        return 0.5 * (self._length - 1) / self._rate

    def reset(self, rates: Rates) -> None:
        """See `FrontEnd.reset`."""
        self._rate = rates.sensor
        self._length = max(1, round(self.window * rates.sensor))
        self._past: tuple[Array, Array] | None = None

    def update(self, wrench: Array, valid: Array) -> Array:
        """See `FrontEnd.update`."""
        weight = np.where(valid, 1.0, 0.0)[..., None]
        n, keep = wrench.shape[-2], self._length
        if self._past is None:
            empty = (*wrench.shape[:-2], keep)
            self._past = np.zeros((*empty, wrench.shape[-1])), np.zeros((*empty, 1))
        heard = np.concatenate((self._past[0], wrench * weight), axis=-2)
        count = np.concatenate((self._past[1], weight), axis=-2)
        self._past = heard[..., n:, :], count[..., n:, :]
        total, samples = _sliding_sum(heard, keep), _sliding_sum(count, keep)
        # Nothing arrived in a whole window: what is repeated is the best there is.
        return np.where(samples > 0.0, total / np.maximum(samples, 1.0), wrench)


def _sliding_sum(values: Array, length: int) -> Array:
    """Return the sum of so many rows up to each one, but for the first ``length``."""
    rows = np.lib.stride_tricks.sliding_window_view(values, length, axis=-2)
    return np.asarray(rows[..., 1:, :, :].sum(axis=-1))
