"""How a run starts: base, human and load at rest, or all in the midst of a steady walk."""

from __future__ import annotations

import math

import numpy as np

from ..basics.errors import InputError
from ..basics.motion import Array
from ..body.walker import Walker
from .chains import State
from .pair import Pair


def set_off(
    pair: Pair,
    walker: Walker,
    start: tuple[float, float, float],
    twist: tuple[float, float],
    rng: np.random.Generator,
    step: float,
) -> Array:
    """Put the bodies at the start, moving as one at a twist, and return the standing wrench, (6,).

    Where the gait is on, the trunk is put where it sways to and the arms so that the hands hold;
    drive and reflexes are as after a while at this command. The wrench is that of
    `Pair.standing_wrench`, whatever the twist.

    Parameters
    ----------
    pair : Pair
    walker : Walker
    start : (x, y, theta)
        Of the base, world axes: m, m, rad.
    twist : (v, omega)
        Of the base, m/s and rad/s: as the drive's limits leave it.
    rng : numpy.random.Generator
        Chooses where in the stride the walk starts.
    step : float
        Physics step in s.
    """
    pair.hands.reset()
    pair.base.reset()
    _put(pair, start, (0.0, 0.0), STILL)
    standing = pair.standing_wrench(step)
    v, omega = twist = pair.base.reset(float(twist[0]), float(twist[1]))
    gait, (ahead, aside, _) = walker.gait, pair.place
    vx, vy = v - omega * aside, omega * ahead
    walker.reset(vx, vy, omega)
    gait.reset(rng, vx)
    if v or omega:
        _put(pair, start, twist, gait.sway()[:4] if gait.enabled else STILL)
    return standing


STILL = (0.0, 0.0, 0.0, 0.0)
"""No sway: place and rate, m and m/s."""


def _put(
    pair: Pair,
    start: tuple[float, float, float],
    twist: tuple[float, float],
    sway: tuple[float, float, float, float],
) -> None:
    """Set every body's state: where it is and moves while the base moves at a twist."""
    x, y, yaw = start
    v, omega = twist
    cos, sin = math.cos(yaw), math.sin(yaw)

    def carried(place: tuple[float, float, float], extra: tuple[float, float]) -> State:
        """Return the state of what is carried along at a place, with a velocity of its own."""
        ahead, aside, turn = place
        vx, vy = v - omega * aside + extra[0], omega * ahead + extra[1]
        return (
            *(x + cos * ahead - sin * aside, y + sin * ahead + cos * aside, yaw + turn),
            *(cos * vx - sin * vy, sin * vx + cos * vy, omega),
        )

    try:
        angles, rates = pair.body.holding(sway)
    except InputError:  # a sway that no arm follows fades in
        sway = STILL
        angles, rates = pair.body.holding(sway)
    ahead, aside, turn = pair.place
    trunk = carried((ahead + sway[0], aside + sway[1], turn), sway[2:])
    load = carried((*pair.handle[:2], 0.0), (0.0, 0.0)) if pair.load else ()
    pair.put(carried((0.0, 0.0, 0.0), (0.0, 0.0)), trunk[:3] + angles + trunk[3:] + rates, load)
