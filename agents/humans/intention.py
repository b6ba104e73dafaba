"""Where a human wants to go: a preferred pace, and a way around what they see."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class IntentionSettings:
    """What a human wants from the walk, shared by every model.

    Parameters
    ----------
    pace : float or None
        Preferred speed in m/s; None is the scenario's pace.
    margin : float
        Distance in m that the human wants between obstacles and both bodies.
    anticipation : float
        Distance in m ahead at which they begin to walk around what they see.
    lookahead : float
        Distance in m ahead of the base at which they aim.
    """

    pace: float | None = None
    margin: float = 0.15
    anticipation: float = 4.0
    lookahead: float = 1.6
