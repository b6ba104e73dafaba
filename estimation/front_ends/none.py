"""No front end: the wrench as it was measured."""

from __future__ import annotations

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.rates import Rates


class NoFrontEnd:
    """Passes every sample on as it was measured."""

    delay = 0.0

    def reset(self, rates: Rates) -> None:
        """See `FrontEnd.reset`."""

    def update(self, wrench: Array, valid: Array) -> Array:
        """See `FrontEnd.update`."""
        return wrench
