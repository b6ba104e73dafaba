"""The protocol of a front end: from the wrench as measured to the wrench as estimators read it."""

from __future__ import annotations

from typing import Protocol

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.rates import Rates


class FrontEnd(Protocol):
    """Cleans the measured wrench at the sensor's rate, before any estimator reads it.

    A constant comes out as it went in, unless the class says ``passes_constant = False``, as one
    that removes a bias does.
    """

    @property
    def delay(self) -> float:
        """By how much a signal of 0.3 Hz comes later than it went in, s; known after `reset`."""
        ...

    def reset(self, rates: Rates) -> None:
        """Start an episode with samples at ``rates.sensor``, in blocks of ``rates.samples``."""
        ...

    def update(self, wrench: Array, valid: Array) -> Array:
        """Return a block of samples, cleaned: a fresh array, or the very input.

        Parameters
        ----------
        wrench : ndarray, shape (..., samples, 6)
            Force (N) and torque (N m), base axes, about the handle, oldest first.
        valid : ndarray, shape (..., samples)
            1 where the sample arrived, 0 where it repeats the one before.

        Returns
        -------
        ndarray, shape (..., samples, 6)
        """
        ...
