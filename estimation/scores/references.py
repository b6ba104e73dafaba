"""What an estimate of stubbornness stands beside: priors, and the calibrated paper's estimate.

Each is fitted on people who are not scored (`held_out`). The third reference, the filter that
is told the wish, is `cowalk.estimation.scores.oracle`. They are references, not bounds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from .uncertainty import crps_discrete

GRID = np.linspace(0.0, 1.0, 51)
"""Values of stubbornness on which histograms and filters stand, the ends among them."""


@dataclass(frozen=True, eq=False)
class Prior:
    """A belief that hears nothing: a histogram of other people's stubbornness.

    Attributes
    ----------
    weights : ndarray, shape (51,)
        Probability of each value of `GRID`.
    mean : float
        The best constant: no other has a smaller mean squared error on what was fitted.
    """

    weights: Array
    mean: float

    @classmethod
    def fit(cls, stubbornness: ArrayLike, weights: ArrayLike, rows: ArrayLike = True) -> Prior:
        """Return the prior of other people.

        Parameters
        ----------
        stubbornness : array_like, shape (rows,)
            s of people who are not scored; NaN where unknown.
        weights : array_like, shape (rows,)
            See `equal_weights`.
        rows : array_like of bool, shape (rows,)
            Rows to fit on: all, or the identifiable ones.

        Raises
        ------
        InputError
            If no row tells anything.
        """
        values, weights = np.asarray(stubbornness, dtype=float), np.asarray(weights, dtype=float)
        known = np.isfinite(values) & np.asarray(rows, dtype=bool)
        if not np.any(weights[known] > 0.0):
            raise InputError("no row of known stubbornness: a prior has nothing to be fitted on")
        share = weights[known] / weights[known].sum()
        nearest = np.rint(np.clip(values[known], 0.0, 1.0) * (GRID.size - 1)).astype(int)
        counts = np.bincount(nearest, share, minlength=GRID.size)
        return cls(counts.astype(float), float(share @ values[known]))

    def crps(self, truth: ArrayLike) -> Array:
        """Return the score of the histogram, row by row, shape (...) as the truth's."""
        return crps_discrete(truth, GRID, self.weights)


def better_prior_crps(truth: ArrayLike, priors: tuple[Prior, ...], rows: ArrayLike = True) -> Array:
    """Return the score, row by row, of the prior that does best on the rows asked for.

    Those to choose from are fitted on all rows and on identifiable ones of other people. It is
    chosen with the truth known, in favour of the reference.

    Parameters
    ----------
    truth : array_like, shape (rows,)
    priors : tuple of Prior
    rows : array_like of bool, shape (rows,)

    Returns
    -------
    ndarray, shape (rows,)
    """
    scores = np.stack([prior.crps(truth) for prior in priors])
    judged = np.where(np.isfinite(scores) & np.asarray(rows, dtype=bool), scores, 0.0)
    return np.asarray(scores[np.argmin(judged.sum(axis=-1))])


@dataclass(frozen=True)
class AffineCalibration:
    """The best affine map of an estimate: of the paper's behind its mean, the reference.

    s = clip(slope * x + offset, 0, 1), least squares on other people and families.

    Attributes
    ----------
    slope, offset : float
    """

    slope: float
    offset: float

    @classmethod
    def fit(
        cls, estimate: ArrayLike, truth: ArrayLike, weights: ArrayLike, rows: ArrayLike = True
    ) -> AffineCalibration:
        """Return the map fitted on people who are not scored.

        An estimate that never moves is mapped to the best constant.

        Parameters
        ----------
        estimate, truth : array_like, shape (rows,)
            NaN where unknown.
        weights : array_like, shape (rows,)
            See `equal_weights`.
        rows : array_like of bool, shape (rows,)

        Raises
        ------
        InputError
            If no row tells anything.
        """
        x, s = np.asarray(estimate, dtype=float), np.asarray(truth, dtype=float)
        weights = np.asarray(weights, dtype=float)
        known = np.isfinite(x) & np.isfinite(s) & np.asarray(rows, dtype=bool)
        if not np.any(weights[known] > 0.0):
            raise InputError("no row of known stubbornness: nothing to be calibrated on")
        x, s, share = x[known], s[known], weights[known] / weights[known].sum()
        about_x, about_s = x - share @ x, s - share @ s
        moves = float(share @ about_x**2)
        slope = float(share @ (about_x * about_s)) / moves if moves > 1e-18 else 0.0
        return cls(slope, float(share @ s - slope * (share @ x)))

    def __call__(self, estimate: ArrayLike) -> Array:
        """Return the calibrated estimate, in [0, 1], shape (...) as the estimate's."""
        return np.clip(self.slope * np.asarray(estimate, dtype=float) + self.offset, 0.0, 1.0)
