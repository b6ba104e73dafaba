"""One walk scored in one dimension: every entry, and the references beside it.

References are fitted on people who are not scored, each family by the others
(`cowalk.estimation.scores.people.held_out`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cowalk.estimation.scores.error import bias, mean_over_rows, squared_error
from cowalk.estimation.scores.lag import lag
from cowalk.estimation.scores.oracle import grid_moments, oracle
from cowalk.estimation.scores.people import equal_weights, held_out
from cowalk.estimation.scores.references import (
    GRID,
    AffineCalibration,
    Prior,
    better_prior_crps,
)
from cowalk.estimation.scores.uncertainty import central_interval, coverage, crps, crps_discrete
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from .walks import PAPER, Walk

PRIOR, CALIBRATED, ORACLE = "prior", "calibrated paper", "oracle"
STRENGTH = "oracle told strength"
REFERENCES = (PRIOR, CALIBRATED, ORACLE, STRENGTH)
LEVEL = 0.9
"""Of the intervals whose coverage is said."""
LATEST = 3.0
"""Longest lag that is looked for, s: who answers later answers to something else."""
BLOCK = 2.0
"""Time over which noise is averaged to see how little it averages out, s: about two strides."""
_SHARE = (0.0, 1.0)


@dataclass(frozen=True)
class Fitted:
    """What other people tell in one dimension, i of (v, omega).

    Attributes
    ----------
    i : int
    always, readable : Prior
        Of s on all rows, and on identifiable ones.
    calibration : AffineCalibration
        Of the paper's estimate behind its mean.
    gain, force_max : ndarray, shape (people,)
        kappa (1) and F_max (N) of each.
    noise : float
        Deviation of what the force behind the front end has besides what was meant, N: of
        the white noise that disturbs as much.
    walk : float
        RMS by which s moves within a second, 1.
    """

    i: int
    always: Prior
    readable: Prior
    calibration: AffineCalibration
    gain: Array
    force_max: Array
    noise: float
    walk: float


class Scores(NamedTuple):
    """Means over the rows of one walk; NaN where there are none.

    On identifiable rows: squared error, bias, CRPS and that of the prior, share of rows on which
    anything was said, coverage of the 90 % interval (NaN where none is stated). On all rows: CRPS
    and that of the prior, squared error of the wish. And the lag against s, s.
    """

    square: float
    bias: float
    crps: float
    crps_prior: float
    said: float
    covered: float
    crps_all: float
    crps_prior_all: float
    wish_square: float
    lag: float


def fits(walks: Sequence[Walk], i: int) -> Iterator[tuple[Fitted, list[int]]]:
    """Yield what was fitted on some, and which walks of others are scored by it.

    Raises
    ------
    InputError
        If one person walked alone, or of those to fit on nobody's stubbornness is known.
    """
    person, family = [walk.person for walk in walks], [walk.family for walk in walks]
    for fit, score in held_out(person, family):
        others = [walk for walk, chosen in zip(walks, fit, strict=True) if chosen]
        yield _fitted(others, i), np.flatnonzero(score).tolist()


def _fitted(walks: Sequence[Walk], i: int) -> Fitted:
    rows = [len(walk.heard) for walk in walks]
    person = np.repeat([walk.person for walk in walks], rows)
    family = np.repeat([walk.family for walk in walks], rows)
    weights = equal_weights(person, family)
    truth = np.concatenate([walk.stubbornness[:, i] for walk in walks])
    readable = np.concatenate([walk.identifiable[:, i] for walk in walks])
    paper = np.concatenate([walk.said[PAPER].stubbornness[:, i] for walk in walks])
    always = Prior.fit(truth, weights)
    try:
        seldom = Prior.fit(truth, weights, readable)
        calibration = AffineCalibration.fit(paper, truth, weights, readable)
    except InputError:  # they disagreed nowhere
        seldom, calibration = always, AffineCalibration.fit(paper, truth, weights)
    second = round(1.0 / walks[0].period)
    moved = [walk.stubbornness[second:, i] - walk.stubbornness[:-second, i] for walk in walks]
    drift = float(np.sqrt(np.nanmean(np.concatenate(moved) ** 2)))
    traits = {walk.person: (walk.gain, walk.force_max[i]) for walk in walks}
    gain, strongest = np.array(list(traits.values())).T
    return Fitted(i, always, seldom, calibration, gain, strongest, _noise(walks, i), drift)


def _noise(walks: Sequence[Walk], i: int) -> float:
    """Return the deviation of white noise that spoils means over `BLOCK` as the force's does.

    Steps and sway last longer than a control period: taken for white as they are, the oracle
    would be sure of what it cannot know.
    """
    squares = []
    for walk in walks:
        meant = walk.force_max[i] * np.clip(walk.gain * walk.demand[:, i], -1.0, 1.0)
        late, size = _late(walk), round(BLOCK / walk.period)
        beside = walk.heard[late:, i] - meant[:-late]
        blocks = beside[: beside.size // size * size].reshape(-1, size).mean(axis=-1)
        squares += [size * block**2 for block in blocks if np.isfinite(block)]
    return max(float(np.sqrt(np.mean(squares))) if squares else 0.0, 1e-3)


def _late(walk: Walk) -> int:
    """Return after how many rows what was meant is heard."""
    return round(walk.delay / walk.period) + 1


def scored(walk: Walk, fitted: Fitted, upper: float, entries: Sequence[str]) -> dict[str, Scores]:
    """Return the scores of a walk by name: the references', then those of the entries.

    Parameters
    ----------
    walk : Walk
    fitted : Fitted
    upper : float
        p_ub of the dimension, m/s or rad/s.
    entries : sequence of str
    """
    i = fitted.i
    truth, rows = walk.stubbornness[:, i], walk.identifiable[:, i]
    priors = fitted.always, fitted.readable
    beside = (
        better_prior_crps(truth, priors, rows),
        better_prior_crps(truth, priors),
    )
    silent = np.full(truth.shape, np.nan)

    def judge(
        mean: Array, errors: Array, deviation: Array = silent, wish: Array = silent
    ) -> Scores:
        # Who is silent returns to what is known without listening: neither costs nor earns.
        filled = np.where(np.isfinite(mean), mean, fitted.readable.mean)
        spoken = np.where(np.isfinite(mean), 1.0, 0.0)
        heard, everywhere = (np.where(np.isfinite(errors), errors, prior) for prior in beside)
        ends = central_interval(mean, deviation, LEVEL, _SHARE)
        within = coverage(truth, *ends, rows & (deviation > 0.0))
        numbers = (
            squared_error(filled, truth, rows).value,
            bias(filled, truth, rows).value,
            mean_over_rows(heard, rows).value,
            mean_over_rows(beside[0], rows).value,
            mean_over_rows(spoken, rows).value,
            within.value,
            mean_over_rows(everywhere).value,
            mean_over_rows(beside[1]).value,
            squared_error(wish, walk.wish[:, i]).value,
            lag(mean, truth, walk.period, LATEST),
        )
        return Scores(*(float(number) for number in numbers))

    constant = np.full(truth.shape, fitted.readable.mean)
    calibrated = fitted.calibration(walk.said[PAPER].stubbornness[:, i])
    found = {
        PRIOR: judge(constant, silent),
        CALIBRATED: judge(calibrated, np.abs(calibrated - truth)),
    }
    for name in entries:
        said = walk.said[name]
        mean, deviation = said.stubbornness[:, i], said.deviation[:, i]
        found[name] = judge(mean, crps(truth, mean, deviation, _SHARE), deviation, said.wish[:, i])
    product = walk.gain * walk.force_max[i]
    told = {
        ORACLE: (fitted.gain, fitted.force_max),
        # Of the pairs with that product, those whose strength is as other people's.
        STRENGTH: (product / fitted.force_max, fitted.force_max),
    }
    for name, (gain, strongest) in told.items():
        beliefs = oracle(
            walk.heard[:, i],
            walk.wish[:, i],
            walk.before[:, i],
            upper,
            prior=fitted.always.weights,
            gain=gain,
            force_max=strongest,
            noise=fitted.noise,
            period=walk.period,
            delay=walk.delay + walk.period,
            walk=fitted.walk,
        )
        mean, deviation = grid_moments(beliefs)
        found[name] = judge(mean, crps_discrete(truth, GRID, beliefs), deviation)
    return found
