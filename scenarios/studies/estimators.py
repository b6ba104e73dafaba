"""Smoothers, observers and front ends, scored on people who walk, beside the references."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cowalk.estimation.scores.gap import gap_closed
from cowalk.estimation.scores.people import (
    Interval,
    People,
    bootstrap,
    by_person,
    mean_over_people,
)
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from ..files.schema import Scenario
from ..people.population import Population
from ..running.parallel import each_of
from ..running.runner import Progress
from .beside import CALIBRATED, ORACLE, PRIOR, REFERENCES, STRENGTH, Scores, fits, scored
from .estimator_scores import DimensionScores, Estimators, EstimatorScore
from .places import WORLDS
from .side_by_side import entries_of
from .walks import Walk, walks

DIMENSIONS = {"v": "m/s", "omega": "rad/s"}


def compare_estimators(
    scenario: Scenario,
    kind: str,
    own: Sequence[str],
    population: Population,
    people: int = 20,
    progress: Progress | None = None,
    jobs: int = -1,
) -> Estimators:
    """Let people walk while every part of a kind listens, and score what it makes of them.

    Parameters
    ----------
    scenario : Scenario
        Its automation acts; the part of the kind that it names keeps its parameters, the others
        have defaults.
    kind : str
        ``"smoother"``, ``"observer"`` or ``"front end"``.
    own : sequence of str
        Compared besides the registered ones, each ``module:Class``.
    population : Population
    people : int
        Each walks three times, the obstacles elsewhere.
    progress : callable, optional
        Called with the walks done and their total.
    jobs : int
        Processes at once; -1 is one a core.

    Raises
    ------
    InputError
        If there are fewer than two people, a name is unknown, an entry fails, or nobody can walk.
    """
    names = entries_of(scenario, kind, own)
    found, left_out = walks(scenario, kind, names, population, people, progress, jobs)
    upper = scenario.bounds.upper
    dimensions = tuple(
        score_dimension(found, kind, names, i, float(upper[i]), jobs)
        for i in range(len(DIMENSIONS))
    )
    return Estimators(
        scenario.name,
        population.name,
        kind,
        tuple(names),
        people,
        WORLDS,
        left_out,
        dimensions,
    )


def score_dimension(
    found: list[Walk],
    kind: str,
    names: Sequence[str],
    i: int,
    upper: float,
    jobs: int = -1,
) -> DimensionScores:
    """Return the scores of walks in one dimension.

    Parameters
    ----------
    found : list of Walk
    kind : str
        Of the entries.
    names : sequence of str
        Entries, whose estimates the walks have.
    i : int
        0 for v, 1 for omega.
    upper : float
        p_ub, m/s or rad/s.
    jobs : int
        Processes at once; -1 is one a core.

    Raises
    ------
    InputError
        If one person walked alone.
    """
    dimension, unit = list(DIMENSIONS.items())[i]
    readable = np.array([walk.identifiable[:, i].mean() for walk in found])[:, None]
    person, family = [walk.person for walk in found], [walk.family for walk in found]
    share = float(mean_over_people(by_person(readable, person, family))[0])
    if not share > 0.0:
        return DimensionScores(dimension, unit, share, 0, (), ())
    tasks = [(fitted, place) for fitted, places in fits(found, i) for place in places]
    whole = [(found[place], fitted, upper, names) for fitted, place in tasks]
    results = each_of(scored, whole, jobs=jobs)
    by_walk: list[dict[str, Scores]] = [{}] * len(found)
    for (_, place), result in zip(tasks, results, strict=True):
        by_walk[place] = result
    order = [PRIOR, CALIBRATED, *names, ORACLE, STRENGTH]
    numbers = np.array([[walk[name] for name in order] for walk in by_walk])
    rests = _several(by_person(numbers[..., :_OF_ROWS], person, family))
    if not len(rests.values):
        return DimensionScores(dimension, unit, share, 0, (), ())
    apart = _Apart(order, numbers, rests, person, family)
    scores = tuple(apart.score(name, kind) for name in order)
    families = tuple(np.unique(rests.family).tolist())
    return DimensionScores(dimension, unit, share, len(rests.values), families, scores)


_FIELDS = Scores._fields
_OF_ROWS = _FIELDS.index("said")
"""Fields up to here are known of every walk with an identifiable row."""


def _several(people: People) -> People:
    """Return the people whose family has at least two: one alone says nothing of a family."""
    names, counts = np.unique(people.family, return_counts=True)
    kept = np.isin(people.family, names[counts > 1])
    return People(people.values[kept], people.family[kept])


class _Apart:
    """The numbers of all walks, and the scores of each name."""

    def __init__(
        self, order: list[str], numbers: Array, rests: People, person: Any, family: Any
    ) -> None:
        self._order, self._numbers, self._rests = order, numbers, rests
        self._person, self._family = person, family

    def score(self, name: str, kind: str) -> EstimatorScore:
        own = self._order.index(name)
        reference = name in REFERENCES
        square = _FIELDS.index("square")
        squares = People(self._rests.values[..., square], self._rests.family)
        better = tuple(
            other
            for other in REFERENCES
            if other != name
            and bootstrap(squares, _difference(own, self._order.index(other))).high < 0.0
        )
        ends = [self._order.index(each) for each in (CALIBRATED, name, ORACLE)]
        gap = None
        if not reference:
            gap = gap_closed(People(squares.values[:, ends], squares.family), root=True).share
        return EstimatorScore(
            name=name,
            reference=reference,
            rmse=bootstrap(squares, lambda means: np.sqrt(means[..., own])),
            bias=self._mean(own, "bias"),
            skill=None if name == PRIOR else self._skill(own, "crps", "crps_prior"),
            skill_all=None if name == PRIOR else self._skill(own, "crps_all", "crps_prior_all"),
            lag=_median(self._numbers[:, own, _FIELDS.index("lag")]),
            said=self._mean(own, "said"),
            covered=self._mean(own, "covered"),
            wish_rmse=float("nan")
            if kind == "smoother" or reference
            else float(np.sqrt(self._mean(own, "wish_square"))),
            better_than=better,
            gap_closed=gap,
        )

    def _mean(self, own: int, field: str) -> float:
        values = self._numbers[:, own, _FIELDS.index(field)][:, None]
        try:
            return float(mean_over_people(by_person(values, self._person, self._family))[0])
        except InputError:  # nothing was said, or stated
            return float("nan")

    def _skill(self, own: int, field: str, prior: str) -> Interval | None:
        columns = [_FIELDS.index(field), _FIELDS.index(prior)]
        values = self._numbers[:, own, columns]
        people = _several(by_person(values, self._person, self._family))
        return bootstrap(people, lambda means: 1.0 - means[..., 0] / means[..., 1])


def _difference(own: int, other: int) -> Any:
    return lambda means: np.sqrt(means[..., own]) - np.sqrt(means[..., other])


def _median(lags: Array) -> float:
    known = lags[np.isfinite(lags)]
    return float(np.median(known)) if known.size else float("nan")
