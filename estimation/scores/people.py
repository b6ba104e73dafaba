"""Averages over runs, people and families, and how sure they are."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

LEVEL = 0.95


class People(NamedTuple):
    """What is averaged: one row a person.

    Attributes
    ----------
    values : ndarray, shape (people, ...)
        Mean over the runs of each.
    family : ndarray of str, shape (people,)
        The family of human models that each belongs to.
    """

    values: Array
    family: NDArray[np.str_]


class Interval(NamedTuple):
    """A number and its bootstrap interval of 95 %."""

    value: float
    low: float
    high: float


def held_out(
    person: ArrayLike, family: ArrayLike
) -> Iterator[tuple[NDArray[np.bool_], NDArray[np.bool_]]]:
    """Yield what to fit on and what to score, until everybody was scored once.

    Each family is scored by what was fitted on the others; where there is one family alone,
    each person by what was fitted on the other people.

    Parameters
    ----------
    person, family : array_like of str, shape (n,)
        Of each run or row.

    Yields
    ------
    (ndarray of bool, ndarray of bool), each of shape (n,)
        To fit on, to score; no person is in both.

    Raises
    ------
    InputError
        If there is one person alone.
    """
    family = np.asarray(family, dtype=str)
    labels = family if np.unique(family).size > 1 else np.asarray(person, dtype=str)
    names = np.unique(labels)
    if names.size < 2:
        raise InputError("one person alone: a reference is fitted on other people")
    for name in names:
        yield labels != name, labels == name


def equal_weights(person: ArrayLike, family: ArrayLike) -> Array:
    """Return weights of rows by which families count alike, and people alike within them.

    Parameters
    ----------
    person, family : array_like of str, shape (rows,)
        Who each row belongs to.

    Returns
    -------
    ndarray, shape (rows,)
        Their sum is 1.
    """
    person, family = np.asarray(person, dtype=str), np.asarray(family, dtype=str)
    whose, row, rows = np.unique(
        np.stack((family, person)), axis=1, return_inverse=True, return_counts=True
    )
    _, among, people = np.unique(whose[0], return_inverse=True, return_counts=True)
    return np.asarray(1.0 / (rows * people[among] * people.size))[row.ravel()]


def by_person(values: ArrayLike, person: ArrayLike, family: ArrayLike) -> People:
    """Return the mean of each person's runs.

    What is compared stands in columns of one row: a run in which one of them is unknown is
    left out for all, so that they stay paired; a person without any such run, too.

    Parameters
    ----------
    values : array_like, shape (runs, ...)
        Squared errors, CRPS, metrics; NaN where a run tells nothing.
    person, family : array_like of str, shape (runs,)
        Who it was. Equal names in two families are two people.

    Raises
    ------
    InputError
        If the shapes do not go together, or no run tells anything.
    """
    values = np.asarray(values, dtype=float)
    person, family = np.asarray(person, dtype=str), np.asarray(family, dtype=str)
    if not len(values) == person.size == family.size:
        raise InputError(
            f"{len(values)} runs, {person.size} people, {family.size} families: "
            "one person and one family a run"
        )
    known = np.isfinite(values).reshape(len(values), -1).all(axis=-1)
    if not known.any():
        raise InputError("no run has a value: there is nothing to average")
    names, which = np.unique(np.stack((family[known], person[known])), axis=1, return_inverse=True)
    totals = np.zeros((names.shape[1], *values.shape[1:]))
    which = which.ravel()
    np.add.at(totals, which, values[known])
    runs = np.bincount(which).reshape(-1, *(1,) * (values.ndim - 1))
    return People(totals / runs, names[0])


def mean_over_people(people: People) -> Array:
    """Return the mean over people, then over families, each family with equal weight.

    Of squared errors, take the root of it last.

    Returns
    -------
    ndarray, shape (...)
    """
    families = [people.values[people.family == name] for name in np.unique(people.family)]
    return np.asarray(np.mean([family.mean(axis=0) for family in families], axis=0))


def bootstrap(
    people: People,
    statistic: Callable[[Array], Array],
    resamples: int = 2000,
    seed: int = 0,
) -> Interval:
    """Return a statistic of the mean over people, and its bootstrap interval of 95 %.

    People are drawn anew within their families, with everything that belongs to them, so that
    columns stay paired. The interval is that of the percentiles, which is right through any
    monotone function (a root) and for ratios.

    Parameters
    ----------
    people : People
        With values of shape (people, columns), at least two people a family.
    statistic : callable
        From means over people, shape (..., columns), to numbers, shape (...): a root, a
        difference, a ratio. It must broadcast.
    resamples : int
    seed : int

    Raises
    ------
    InputError
        If a family has fewer than two people.
    """
    from scipy.stats import bootstrap as resample  # slow to import

    families = [people.values[people.family == name] for name in np.unique(people.family)]
    for name, family in zip(np.unique(people.family), families, strict=True):
        if len(family) < 2:
            raise InputError(f"family {str(name)!r} has 1 person: an interval needs at least 2")

    def drawn(*chosen: NDArray[np.intp], axis: int = -1) -> Array:
        means = [
            family[index].mean(axis=-2) for family, index in zip(families, chosen, strict=True)
        ]
        return statistic(np.mean(means, axis=0))

    # One sample a family, of the numbers of its people: what belongs to a person stays together.
    found = resample(
        [np.arange(len(family)) for family in families],
        drawn,
        n_resamples=resamples,
        vectorized=True,
        confidence_level=LEVEL,
        method="percentile",
        rng=np.random.default_rng(seed),
    ).confidence_interval
    value = float(statistic(mean_over_people(people)))
    return Interval(value, float(found.low), float(found.high))
