"""The negotiation loop that strategies share: read the force, concede, settle, hold."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import deque
from copy import deepcopy

import numpy as np

from cowalk.estimation.front_ends.mean import mean_force
from cowalk.estimation.laws.stubbornness import interaction_value, stubbornness_norm
from cowalk.estimation.observers.paper import PaperObserver
from cowalk.estimation.observers.protocol import ForceReading, Observer
from cowalk.estimation.smoothers.moving_average import MovingAverage
from cowalk.estimation.smoothers.protocol import Smoother
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation

from ..basics.protocols import Belief
from .planner.problem import PROBLEMS
from .planner.settings import NegotiationSettings
from .planner.utility import negotiated


class NegotiatingAutomation(ABC):
    """Renegotiates once a period and holds the agreed primitive in between.

    A strategy says how much utility it gives up; the rest is the paper's loop. Every strategy
    logs the same estimates, whether it uses them or not.

    Parameters
    ----------
    negotiation : NegotiationSettings
    smoother : Smoother
        Smooths the interaction value; a copy of it smooths the logged stubbornness.
    observer : Observer
        Reads stubbornness and wish from the force.
    """

    def __init__(
        self,
        negotiation: NegotiationSettings | None = None,
        smoother: Smoother | None = None,
        observer: Observer | None = None,
    ) -> None:
        self.negotiation = negotiation or NegotiationSettings()
        self._interaction_smoother = smoother or MovingAverage()
        self._stubbornness_smoother = deepcopy(self._interaction_smoother)
        self._observer: Observer = observer or PaperObserver()

    @abstractmethod
    def utility_loss(self, interaction_smoothed: Array) -> Array:
        """Return the utility that is given up, in [0, 1], shape (...)."""

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Automation.reset`."""
        settings = self.negotiation
        self._steps = settings.steps(situation.period)
        self._situation = situation
        self._reading = ForceReading(
            force_max=np.asarray(settings.force_max, dtype=float),
            force_threshold=np.asarray(settings.force_threshold, dtype=float),
            sensitivity=np.asarray(settings.sensitivity, dtype=float),
            lower=np.asarray(situation.bounds.lower, dtype=float),
            upper=np.asarray(situation.bounds.upper, dtype=float),
        )
        self._negotiated = slice(0 if settings.dimensions == "both" else 1, 2)
        self._count = 0
        window = max(1, round(settings.force_window / situation.period))
        self._recent: deque[Observation] = deque(maxlen=window)
        self._belief = Belief()
        self._twist = np.zeros(2)

    def act(self, observation: Observation) -> Array:
        """See `Automation.act`."""
        self._recent.append(observation)
        if self._count % self._steps == 0:
            self._twist = self._negotiate(observation)
        self._count += 1
        return self._twist

    def belief(self) -> Belief:
        """See `Automation.belief`."""
        return self._belief

    def _negotiate(self, observation: Observation) -> Array:
        twist = observation["twist"]
        force = self._mean_force()
        pose = observation["pose_world"]
        if self._count == 0:
            self._observer.reset(self._reading, twist)
            self._loss = np.zeros(twist.shape[:-1])
            self._interaction_smoother.reset(interaction_value(self._loss, self._loss))
            self._stubbornness_smoother.reset(np.zeros(twist.shape))
        estimate, wish = self._observer.update(force, twist)
        interaction = interaction_value(
            stubbornness_norm(estimate[..., self._negotiated]), self._loss
        )
        smoothed = self._interaction_smoother.update(interaction)
        self._loss = self.utility_loss(smoothed)
        problem = PROBLEMS[self.negotiation.dimensions](self.negotiation, self._situation, pose)
        own = problem.wish()
        target = 1.0 - self._loss
        agreed = negotiated(problem, own, self._negotiable(wish), target)
        self._belief = Belief(
            stubbornness=estimate,
            stubbornness_smoothed=self._stubbornness_smoother.update(estimate),
            human_wish=wish,
            wish=own,
            interaction=interaction,
            interaction_smoothed=smoothed,
            utility_loss=self._loss,
            target_utility=target,
            negotiation=self._belief.negotiation + 1,
        )
        return agreed

    def _mean_force(self) -> Array:
        """Return the mean over the window of what arrived, N, shape (..., 2)."""
        recent = self._recent
        force = np.concatenate([seen["force"] for seen in recent], axis=-2)
        if "force_valid" not in recent[0]:
            return mean_force(force, None)
        return mean_force(force, np.concatenate([seen["force_valid"] for seen in recent], axis=-1))

    def _negotiable(self, wish: Array) -> Array:
        """Return the human's wish with the usual pace where v is not negotiated."""
        if self.negotiation.dimensions == "both":
            return wish
        return np.stack((np.full_like(wish[..., 0], self._situation.pace), wish[..., 1]), axis=-1)
