"""The observer of the paper."""

from __future__ import annotations

from cowalk.sim.basics.motion import Array

from ..laws.intent import human_wish, wish_change
from ..laws.stubbornness import stubbornness
from .protocol import Estimate, ForceReading


class PaperObserver:
    """The static model of Schneider et al. (arXiv 2407.17275): stubbornness from force alone."""

    def reset(self, reading: ForceReading, twist: Array) -> None:
        """See `Observer.reset`."""
        self._reading = reading
        self._wish_before = twist

    def update(self, force: Array, twist: Array) -> Estimate:
        """See `Observer.update`."""
        r = self._reading
        share = stubbornness(force, r.force_max, self._wish_before, twist, r.lower, r.upper)
        change = wish_change(force, r.force_max, r.force_threshold, r.sensitivity, r.upper)
        self._wish_before = wish = human_wish(twist, change, r.lower, r.upper)
        return Estimate(share, wish)
