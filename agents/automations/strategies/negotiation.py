"""What a strategy is told at a negotiation, and what it answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from cowalk.estimation.observers.protocol import Estimate
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation

from ..planner.problem import Problem


@dataclass(frozen=True, slots=True, eq=False)
class Negotiation:
    """What is known when a primitive is to be agreed on (leading batch axes come first).

    Attributes
    ----------
    problem : Problem
        What there is to negotiate here: costs, bounds, the front between two wishes.
    own : ndarray, shape (..., 2)
        The automation's own wish p_A*, m/s and rad/s.
    human : ndarray, shape (..., 2)
        The human's estimated wish as far as it is negotiable: v is the usual pace where omega
        alone is negotiated. m/s and rad/s.
    estimate : Estimate
        The observer's, of stubbornness and wish with their deviations.
    stubbornness : ndarray, shape (..., n)
        Its mean in the dimensions that are negotiated, in [0, 1].
    observation : Observation
        All that the automation's seat perceives: pose, twist, obstacles, raw force.
    situation : Situation
    time : float or ndarray, shape (...)
        Since reset, s.
    number : int
        Negotiations before this one.
    """

    problem: Problem
    own: Array
    human: Array
    estimate: Estimate
    stubbornness: Array
    observation: Observation
    situation: Situation
    time: float | Array
    number: int


@dataclass(frozen=True, slots=True, eq=False)
class Agreement:
    """What a strategy settles for until the next negotiation.

    Attributes
    ----------
    twist : ndarray, shape (..., 2)
        The primitive to execute, m/s and rad/s.
    target_utility, utility_loss : float or ndarray, shape (...)
        What the automation demands and gives up, in [0, 1]; NaN for a strategy without such.
    interaction, interaction_smoothed : float or ndarray, shape (...)
        The paper's interaction value, in [-2, 2]; NaN for a strategy without it.
    extras : mapping of str to float
        A number for each of the strategy's own ``columns``.
    """

    twist: Array
    target_utility: float | Array = np.nan
    utility_loss: float | Array = np.nan
    interaction: float | Array = np.nan
    interaction_smoothed: float | Array = np.nan
    extras: Mapping[str, float] = field(default_factory=dict)
