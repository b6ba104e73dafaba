"""What a comparison of estimators says: scores by entry and by dimension."""

from __future__ import annotations

from dataclasses import dataclass

from cowalk.estimation.scores.people import Interval


@dataclass(frozen=True)
class EstimatorScore:
    """How one entry, or reference, follows stubbornness in one dimension, over people.

    Squared errors are averaged over a person's walks, then people, then families with equal
    weight. Where an entry is silent, it counts as the prior.

    Attributes
    ----------
    name : str
    reference : bool
        A reference, told or fitted on what no entry is: no competitor, and no bound.
    rmse : Interval
        Of s on identifiable rows, 1.
    bias : float
        Estimate minus truth on identifiable rows, 1.
    skill, skill_all : Interval or None
        1 - CRPS/CRPS of the prior on identifiable and on all rows; without a stated deviation
        the CRPS is the absolute error. None of the prior itself.
    lag : float
        Behind the true s, median of the walks in which there is one to read, s; else NaN.
    said : float
        Share of the identifiable rows on which anything was said.
    covered : float
        Share of them whose stated 90 % interval holds the truth; NaN where none is stated.
    wish_rmse : float
        Of the estimated wish on all rows, m/s or rad/s; NaN of references and smoothers.
    better_than : tuple of str
        References whose RMSE is larger, with an interval of the paired difference that leaves
        0 out.
    gap_closed : Interval or None
        Share of the way from the calibrated paper's RMSE to the oracle's; None of references, and
        where there is no gap to speak of.
    """

    name: str
    reference: bool
    rmse: Interval
    bias: float
    skill: Interval | None
    skill_all: Interval | None
    lag: float
    said: float
    covered: float
    wish_rmse: float
    better_than: tuple[str, ...]
    gap_closed: Interval | None


@dataclass(frozen=True)
class DimensionScores:
    """The scores in one dimension.

    Attributes
    ----------
    dimension, unit : str
        ``"v"`` or ``"omega"``, and the unit of its wish.
    identifiable : float
        Share of the rows from 3 s on in which s could be read from force.
    people : int
        Who had such rows, in families of at least two: what the scores rest on.
    families : tuple of str
        Their human models.
    scores : tuple of EstimatorScore
        Prior, calibrated paper, entries, oracles; empty where nobody's s could be read.
    """

    dimension: str
    unit: str
    identifiable: float
    people: int
    families: tuple[str, ...]
    scores: tuple[EstimatorScore, ...]


@dataclass(frozen=True)
class Estimators:
    """Estimators side by side.

    Attributes
    ----------
    scenario, population, kind : str
    entries : tuple of str
        What was compared.
    people, worlds : int
        Drawn, and walks of each.
    left_out : int
        Walks that could not be walked.
    dimensions : tuple of DimensionScores
    """

    scenario: str
    population: str
    kind: str
    entries: tuple[str, ...]
    people: int
    worlds: int
    left_out: int
    dimensions: tuple[DimensionScores, ...]
