"""The paper's observer: a static model of one force a negotiation."""

from __future__ import annotations

from collections import deque

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.situation import Situation

from ..front_ends.mean import mean_force
from ..laws.intent import human_wish, wish_change
from ..laws.stubbornness import stubbornness
from .protocol import Estimate, ForceReading
from .sample import Sample


class PaperObserver:
    """The static model of Schneider et al. (arXiv 2407.17275): stubbornness from force alone.

    It averages the force over the reading's window, reads it once a negotiation, and holds what
    it read in between. It states no deviation.
    """

    def reset(self, situation: Situation, reading: ForceReading, rng: np.random.Generator) -> None:
        """See `Observer.reset`."""
        self._reading = reading
        self._lower = np.asarray(situation.bounds.lower, dtype=float)
        self._upper = np.asarray(situation.bounds.upper, dtype=float)
        self._steps = max(1, round(reading.period / situation.period))
        window = max(1, round(reading.window / situation.period))
        self._recent: deque[Sample] = deque(maxlen=window)
        self._count = 0
        self._wish_before: Array | None = None

    def update(self, sample: Sample, own_wish: Array) -> Estimate:
        """See `Observer.update`."""
        self._recent.append(sample)
        if self._count % self._steps == 0:
            self._estimate = self._read(self._mean(), sample.twist)
        self._count += 1
        return self._estimate

    def _read(self, force: Array, twist: Array) -> Estimate:
        r, lower, upper = self._reading, self._lower, self._upper
        before = twist if self._wish_before is None else self._wish_before
        share = stubbornness(force, r.force_max, before, twist, lower, upper)
        change = wish_change(force, r.force_max, r.force_threshold, r.sensitivity, upper)
        self._wish_before = wish = human_wish(twist, change, lower, upper)
        return Estimate(share, wish)

    def _mean(self) -> Array:
        """Return the mean over the window of what arrived, N, shape (..., 2)."""
        recent = self._recent
        force = np.concatenate([sample.force for sample in recent], axis=-2)
        return mean_force(force, np.concatenate([sample.valid for sample in recent], axis=-1))
