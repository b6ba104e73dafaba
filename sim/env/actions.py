"""What the seats may do in a control step, and what is made of an action beyond it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from ..basics.errors import SimulationError
from ..basics.motion import Array, TwistBounds
from ..basics.validators import shown

_WHAT = {"human": "force", "automation": "twist"}


_REAL = "fiu"
"""Kinds of NumPy's types whose values are real numbers."""


class Actions:
    """The action spaces of both seats, and actions brought into them.

    Parameters
    ----------
    bounds : TwistBounds
        Of the automation's twist.
    force_limit : float
        Of the human's force, either way in each direction, N.
    """

    def __init__(self, bounds: TwistBounds, force_limit: float) -> None:
        limit = np.full(2, force_limit)
        self.spaces = {
            "human": Box(-limit, limit, dtype=np.float64),
            "automation": Box(np.array(bounds.lower), np.array(bounds.upper), dtype=np.float64),
        }
        self._limits = {
            seat: (*box.low.tolist(), *box.high.tolist()) for seat, box in self.spaces.items()
        }
        self._seats = " and ".join(self._limits)

    def of_both(
        self, actions: Mapping[str, Array], time: float
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the human's force (N) and the automation's twist (m/s, rad/s), clipped.

        Raises
        ------
        SimulationError
            If it is no mapping, a seat has no action or an action no seat, or `bounded` refuses
            one.
        """
        if not isinstance(actions, Mapping):
            raise SimulationError(
                f"step: {shown(actions)} is no mapping; give an action to each of {self._seats}"
            )
        if actions.keys() != self._limits.keys():
            missing = [f"{seat!r} has no action" for seat in self._limits if seat not in actions]
            unknown = [f"{name!r} is no seat" for name in actions if name not in self._limits]
            raise SimulationError(
                f"step: {', '.join(missing + unknown)}; give one to each of {self._seats}"
            )
        return (
            self.bounded("human", actions["human"], time),
            self.bounded("automation", actions["automation"], time),
        )

    def bounded(self, seat: str, action: Array, time: float) -> tuple[float, float]:
        """Return an action, clipped to its space.

        Parameters
        ----------
        seat : str
        action : ndarray, shape (2,)
        time : float
            Since reset, s: for the message.

        Raises
        ------
        SimulationError
            If the action is not two finite numbers.
        """
        pair = pair_of(action)
        if pair is None:
            raise SimulationError(
                f"the {seat}'s {_WHAT[seat]} is {shown(action)} at t = {time:g} s: it must be "
                "2 numbers, without batch axes"
            )
        first, second = float(pair[0]), float(pair[1])
        # The sum is NaN or infinite exactly if a part is.
        if not -1e300 < first + second < 1e300:
            raise SimulationError(
                f"the {seat}'s {_WHAT[seat]} is [{first}, {second}] at t = {time:g} s: "
                "every action must be finite"
            )
        low_1, low_2, high_1, high_2 = self._limits[seat]
        return min(max(first, low_1), high_1), min(max(second, low_2), high_2)


def pair_of(action: Any) -> NDArray[Any] | None:
    """Return an action as an array of two real numbers; None if it is anything else."""
    try:
        pair = action if type(action) is np.ndarray else np.asarray(action)
    except (ValueError, TypeError):  # lists of unequal length
        return None
    return pair if pair.shape == (2,) and pair.dtype.kind in _REAL else None
