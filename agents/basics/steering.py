"""What a sideways push asks for, when hands hold on behind the point about which the base turns.

On a handle of the base one pushes to the side that one wants to turn to. At the far end of a
load behind it one pushes to the other side, as one steers a trailer by its tail: that turns the
whole, and as the tail swings, what it does to the hands opposes a turn that they did not ask for.
Agents speak of turns, so they get and give sideways forces with the sign of the turn asked for.
"""

from __future__ import annotations

import numpy as np

from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation

_TO_THE_OTHER_SIDE = np.array([1.0, -1.0])


def mirrored(force: Array) -> Array:
    """Return a force, shape (..., 2), N, with its sideways part on the other side."""
    return np.asarray(force * _TO_THE_OTHER_SIDE)


def mirrored_observation(observation: Observation) -> Observation:
    """Return what is perceived with ``force`` mirrored, and all else as it is."""
    seen = observation.copy()
    seen["force"] = mirrored(seen["force"])
    return seen
