"""A Kalman filter of a value that drifts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.validators import Range, require_ranges

NOISE: Range = (1e-6, 1e6, "")
"""What rounding leaves of a filter beyond that is nothing (inferred)."""


@dataclass
class KalmanSmoother:
    """Causal Kalman filter (filterpy) of a value that drifts at a slowly changing rate.

    State ``[value, rate]`` with white acceleration noise of discrete time, one negotiation
    being the unit of time; elements of an array are filtered independently with one gain.

    Parameters
    ----------
    process_noise : float
        Standard deviation of the acceleration, units of the value per squared negotiation.
    measurement_noise : float
        Standard deviation of one value, units of the value.

    Raises
    ------
    InputError
        If one is outside of `NOISE`.
    """

    process_noise: float = 0.05
    measurement_noise: float = 0.3

    def __post_init__(self) -> None:
        require_ranges(self, {"process_noise": NOISE, "measurement_noise": NOISE})

    def reset(self, initial: ArrayLike) -> None:
        """See `Smoother.reset`."""
        # filterpy takes a second to import; whoever averages need not wait for it.
        from filterpy.common import Q_discrete_white_noise
        from filterpy.kalman import KalmanFilter

        first = np.asarray(initial, dtype=float)
        self._shape = first.shape
        size = first.size
        each = np.eye(size)
        noise = Q_discrete_white_noise(dim=2, dt=1.0, var=self.process_noise**2)
        self._filter = KalmanFilter(dim_x=2 * size, dim_z=size)
        self._filter.x = np.kron(first.reshape(-1, 1), [[1.0], [0.0]])
        self._filter.F = np.kron(each, [[1.0, 1.0], [0.0, 1.0]])
        self._filter.H = np.kron(each, [[1.0, 0.0]])
        self._filter.Q = np.kron(each, noise)
        self._filter.R = each * self.measurement_noise**2
        self._filter.P = np.kron(each, np.zeros((2, 2)))

    def update(self, value: ArrayLike) -> Array:
        """See `Smoother.update`."""
        self._filter.predict()
        self._filter.update(np.asarray(value, dtype=float).reshape(-1, 1))
        return np.asarray(self._filter.x[::2, 0]).reshape(self._shape).copy()
