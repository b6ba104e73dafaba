"""The mean of the samples that arrived."""

from __future__ import annotations

import numpy as np

from cowalk.sim.basics.motion import Array


def mean_force(force: Array, valid: Array | None = None) -> Array:
    """Return the mean of the samples that arrived.

    Parameters
    ----------
    force : ndarray, shape (..., samples, 2)
        N.
    valid : ndarray, shape (..., samples), optional
        1 or 0, as ``force_valid`` of an observation; without it, or where no sample arrived, all
        samples count.

    Returns
    -------
    ndarray, shape (..., 2)
    """
    if valid is None or valid.all():
        return np.asarray(force.mean(axis=-2))
    weight = np.where(valid.any(axis=-1, keepdims=True), valid, 1.0)[..., None]
    return np.asarray((force * weight).sum(axis=-2) / weight.sum(axis=-2))
