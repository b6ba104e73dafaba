"""The mean of the last values: the paper's smoother."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.validators import require_whole

LONGEST = 100_000
"""Values in a mean: a day of negotiations (inferred)."""


@dataclass
class MovingAverage:
    """Mean of the last values: the paper's smoother, with its l = 5.

    Parameters
    ----------
    window : int
        Number of values l in the mean.

    Raises
    ------
    InputError
        If it is no whole number from 1 to `LONGEST`.
    """

    window: int = 5

    def __post_init__(self) -> None:
        require_whole("window", self.window, 1, LONGEST)

    def reset(self, initial: ArrayLike) -> None:
        """See `Smoother.reset`."""
        first = np.asarray(initial, dtype=float)
        self._values = deque([first] * self.window, maxlen=self.window)

    def update(self, value: ArrayLike) -> Array:
        """See `Smoother.update`."""
        self._values.append(np.asarray(value, dtype=float))
        return np.asarray(sum(self._values) / self.window)
