"""The made-up stream on which estimators are tested: what reaches them in a run, and worse."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cowalk.sim.basics.motion import Array, TwistBounds
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.situation import Situation

from ..observers.protocol import ForceReading
from ..observers.sample import Sample

PATH = Path(((0.0, 0.0), (30.0, 0.0)))
BOUNDS = TwistBounds((0.0, -0.5), (1.2, 0.5))
SITUATION = Situation(PATH, 0.8, BOUNDS, 0.05)
STEPS = 160
CHANNELS = np.array([3.0, -2.0, 5.0, 0.4, -0.3, 0.8])
"""A size for each channel of a wrench, N and N m: no two alike, so that none stands for another."""
LOST = {0: slice(0, 3), 30: slice(4, 7), 60: slice(None)}
"""Samples of the force that are lost, by step."""
_OFF, _HALT, _ON = 10, 100, 112
"""Steps at which the base sets off from rest, stands still, and goes on."""
_RENEGOTIATED = 14
_NOISE = 0.1


def situation(rates: Rates) -> Situation:
    """Return the made-up situation at other rates."""
    return Situation(PATH, 0.8, BOUNDS, rates.period, rates=rates)


def reading() -> ForceReading:
    """Return how force is to be read: full insistence at 7.5 N, a negotiation each 0.7 s."""
    return ForceReading(np.full(2, 7.5), np.zeros(2), np.full(2, 0.5), _RENEGOTIATED * 0.05)


def motion(swing: float, period: float = 0.05) -> Iterator[tuple[float, Array, Array]]:
    """Yield time, twist and pose of a walk along the world's x axis from rest, with a halt.

    Parameters
    ----------
    swing : float
        Scales how far the twist swings about a steady walk, 1.
    period : float
        Control period, s.
    """
    pose = np.zeros(3)
    for step in range(STEPS):
        time = step * period
        v = 0.7 + 0.2 * swing * np.sin(2.0 * time)
        twist = _going(step) * np.array([v, 0.25 * swing * np.cos(1.4 * time)])
        turned = np.array([np.cos(pose[2]), np.sin(pose[2])])
        pose = pose + period * np.array([*(twist[0] * turned), twist[1]])
        yield time, twist, pose.copy()


def _going(step: int) -> float:
    """Return the share of its speed at which the base walks: 0 is exact rest."""
    if step < _OFF or _HALT <= step < _ON:
        return 0.0
    since = step - (_OFF if step < _HALT else _ON)
    return min(1.0, (since + 1) / 10)


def times(rates: Rates, duration: float) -> Array:
    """Return the sensor's instants, s, shape (n,), in whole control steps."""
    return np.arange(round(duration * rates.control) * rates.samples) / rates.sensor


def blocks(wrench: Array, rates: Rates) -> Iterator[tuple[Array, Array]]:
    """Yield a wrench and its validity in blocks of a control step, with losses.

    Parameters
    ----------
    wrench : ndarray, shape (n, 6)
    rates : Rates

    Yields
    ------
    (ndarray, ndarray), shapes (samples, 6) and (samples,)
        A lost sample repeats the one before, zero at the start.
    """
    n = rates.samples
    before = np.zeros(6)
    for step in range(len(wrench) // n):
        block, valid = wrench[step * n : (step + 1) * n].copy(), np.ones(n)
        valid[LOST.get(step, slice(0))] = 0.0
        for row in range(n):
            if not valid[row]:
                block[row] = before
            before = block[row]
        yield block, valid


def pushing(rates: Rates, push: float = 1.0) -> Array:
    """Return the wrench of somebody who pushes to and fro and leans in for a while, with noise.

    Parameters
    ----------
    rates : Rates
    push : float
        Scales what the human does, 1; the noise stays.

    Returns
    -------
    ndarray, shape (n, 6)
        N and N m, over the `STEPS` of the walk.
    """
    t = times(rates, STEPS * rates.period)
    swing = np.sin(np.multiply.outer(t, (1.0, 0.9, 2.0, 0.8, 0.6, 0.7)))
    leaning = np.zeros_like(swing)
    leaning[(t > 2.0) & (t < 3.5)] = 1.0
    noise = np.random.default_rng(11).normal(scale=_NOISE, size=swing.shape)
    return np.asarray(push * CHANNELS * (swing + leaning) + noise)


def samples(rates: Rates, push: float = 1.0) -> Iterator[tuple[Sample, Array]]:
    """Yield the walk as an observer hears it, with the automation's own wish.

    Parameters
    ----------
    rates, push
        See `pushing`.
    """
    heard = blocks(pushing(rates, push), rates)
    for step, (time, twist, pose) in enumerate(motion(1.0, rates.period)):
        wrench, valid = next(heard)
        turn = 0.1 * (step // _RENEGOTIATED % 3)
        yield Sample(wrench, valid, twist, pose, rates.period, time), np.array([0.8, turn])
