"""What a sideways push asks for, when hands hold on behind the point about which the base turns.

On a handle of the base one pushes to the side that one wants to turn to. At the far end of a
load behind it one pushes to the other side, as one steers a trailer by its tail: that turns the
whole, and as the tail swings, what it does to the hands opposes a turn that they did not ask for.
Agents speak of turns, so they get and give sideways forces with the sign of the turn asked for.
A torque asks for a turn of its own sign wherever it acts.
"""

from __future__ import annotations

from ..basics.motion import Array


def as_felt(wrench: Array, from_behind: bool) -> Array:
    """Return a wrench as agents speak of it: a fresh array.

    Parameters
    ----------
    wrench : ndarray, shape (..., 6)
        Force (N) and torque about the handle (N m), base axes.
    from_behind : bool
        See `cowalk.sim.plant.protocol.Plant.steers_from_behind`.
    """
    felt = wrench.copy()
    if from_behind:
        felt[..., 1] *= -1.0
    return felt


def as_pushed(force: tuple[float, float], from_behind: bool) -> tuple[float, float]:
    """Return the force on the base, N, base axes, that an agent's force stands for."""
    return (force[0], -force[1]) if from_behind else force
