"""Force-torque sensor on the handle: what the measured reaction becomes before anyone reads it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .errors import InputError
from .motion import Array


@dataclass(frozen=True)
class SensorParameters:
    """A sensor without faults unless told otherwise.

    Parameters
    ----------
    noise : (float, float)
        Standard deviation of white noise along and across the base, N a sample.
    bias : (float, float)
        Constant offset along and across the base, N.
    resolution : float
        Step between readings, N; 0 is continuous.
    range : float
        Largest reading either way, N.

    Raises
    ------
    InputError
        If noise or resolution is negative or the range is not positive.
    """

    noise: tuple[float, float] = (0.0, 0.0)
    bias: tuple[float, float] = (0.0, 0.0)
    resolution: float = 0.0
    range: float = float("inf")

    def __post_init__(self) -> None:
        if not (min(self.noise) >= 0.0 and self.resolution >= 0.0 and self.range > 0.0):
            raise InputError(
                f"sensor: noise = {self.noise} N and resolution = {self.resolution} N must be at "
                f"least 0, range = {self.range} N above 0"
            )


class ForceSensor:
    """Adds bias and noise, then cuts to the range and rounds to the resolution.

    Parameters
    ----------
    parameters : SensorParameters
    rng : numpy.random.Generator
        The sensor's own.
    """

    def __init__(self, parameters: SensorParameters, rng: np.random.Generator) -> None:
        self._parameters = parameters
        self._exact = parameters == SensorParameters()
        self.reset(rng)

    def reset(self, rng: np.random.Generator) -> None:
        """Start over with a generator of its own."""
        self._rng = rng

    def measure(self, force_on_base: Array) -> Array:
        """Return the readings for a block of samples.

        Parameters
        ----------
        force_on_base : ndarray, shape (n, 2)
            Force of the human on the base, base axes, N, oldest sample first.

        Returns
        -------
        ndarray, shape (n, 2)
            The very input where the sensor is without faults.
        """
        if self._exact:
            return force_on_base
        p = self._parameters
        reading = force_on_base + p.bias + self._rng.standard_normal(force_on_base.shape) * p.noise
        reading = np.clip(reading, -p.range, p.range)
        if p.resolution > 0.0:
            reading = np.round(reading / p.resolution) * p.resolution
        return reading
