"""A sensor's parameters as numbers of its six channels: three forces, then three torques."""

from __future__ import annotations

import numpy as np

from ..basics.motion import Array
from .parameters import SensorParameters

CHANNELS = 6
FORCES, TORQUES = slice(0, 3), slice(3, 6)


def channels(parameters: SensorParameters, name: str) -> Array:
    """Return a parameter that forces and torques have in different units, shape (6,).

    Parameters
    ----------
    parameters : SensorParameters
    name : str
        Of the field for forces; that for torques is called ``torque_`` and the same.

    Returns
    -------
    ndarray, shape (6,)
        A list of 2 is for x and y, and 0 about or along z.
    """
    six = np.zeros(CHANNELS)
    for field, part in ((name, FORCES), (f"torque_{name}", TORQUES)):
        given = np.asarray(getattr(parameters, field), dtype=float)
        six[part][: given.size if given.ndim else None] = given
    return six


def coupling(parameters: SensorParameters) -> Array | None:
    """Return what a row of loads is multiplied with, shape (6, 6); None where that changes nothing.

    A single share c couples every channel with every other one, each counted in shares of its
    full scale: r_i = l_i + c sum_j (R_i / R_j) l_j. With an endless range there is no full scale:
    forces then couple with forces alone, and torques with torques.

    Parameters
    ----------
    parameters : SensorParameters
    """
    shares = np.asarray(parameters.cross_talk, dtype=float)
    whole = np.zeros((CHANNELS, CHANNELS))
    if not shares.ndim:
        full = channels(parameters, "range")
        if np.isfinite(full).all():
            whole = full[:, None] / full
        else:
            whole[FORCES, FORCES] = whole[TORQUES, TORQUES] = 1.0
        np.fill_diagonal(whole, 0.0)
        whole *= shares
    else:
        whole[: len(shares), : len(shares)] = shares
    return np.eye(CHANNELS) + whole.T if whole.any() else None
