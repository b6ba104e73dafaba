"""How far an estimate comes from the calibrated paper's towards the oracle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from .people import Interval, People, bootstrap


@dataclass(frozen=True)
class GapClosed:
    """How far an entry comes from the calibrated paper's estimate towards the oracle.

    Attributes
    ----------
    share : Interval or None
        (calibrated - entry)/(calibrated - oracle); None where the gap's interval reaches 0: a
        share of nothing. Print the difference there.
    difference : Interval
        calibrated - entry, in the units of the score.
    gap : Interval
        calibrated - oracle.
    beats_oracle : bool
        The entry has the better value: the oracle is a reference, not a bound. Say so.
    """

    share: Interval | None
    difference: Interval
    gap: Interval
    beats_oracle: bool


def gap_closed(people: People, root: bool, resamples: int = 2000, seed: int = 0) -> GapClosed:
    """Return the share of the gap that an entry closes, bootstrapped as a ratio.

    Parameters
    ----------
    people : People
        Scores of each person, less being better, of calibrated, entry and oracle: shape
        (people, 3).
    root : bool
        The scores are squared errors, whose root is taken last (RMSE); of CRPS, it is not.
    resamples, seed
        See `bootstrap`.

    Raises
    ------
    InputError
        If there are not three columns, or a family has fewer than two people.
    """
    if people.values.shape[1:] != (3,):
        raise InputError("scores of calibrated, entry and oracle are expected, a row a person")

    def scores(means: Array) -> Array:
        return np.moveaxis(np.sqrt(means) if root else means, -1, 0)

    def difference(means: Array) -> Array:
        calibrated, entry, _ = scores(means)
        return np.asarray(calibrated - entry)

    def gap(means: Array) -> Array:
        calibrated, _, oracle = scores(means)
        return np.asarray(calibrated - oracle)

    apart = bootstrap(people, gap, resamples, seed)
    moved = bootstrap(people, difference, resamples, seed)
    share = None
    if apart.low > 0.0:

        def ratio(means: Array) -> Array:
            with np.errstate(divide="ignore", invalid="ignore"):
                return np.asarray(difference(means) / gap(means))

        share = bootstrap(people, ratio, resamples, seed)
    return GapClosed(share, moved, apart, moved.value > apart.value)
