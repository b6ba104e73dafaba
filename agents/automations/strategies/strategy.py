"""The loop that strategies share: hear, estimate, negotiate once a period, hold in between."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from cowalk.estimation.front_ends.none import NoFrontEnd
from cowalk.estimation.front_ends.protocol import FrontEnd
from cowalk.estimation.observers.paper import PaperObserver
from cowalk.estimation.observers.protocol import Estimate, ForceReading, Observer
from cowalk.estimation.observers.sample import Sample
from cowalk.estimation.smoothers.moving_average import MovingAverage
from cowalk.estimation.smoothers.protocol import Smoother
from cowalk.sim.basics.errors import InputError, PartError
from cowalk.sim.basics.motion import Array
from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation
from cowalk.sim.basics.validators import require, require_instance, require_part, said

from ...basics.protocols import Belief
from ..planner.problem import PROBLEMS
from ..planner.settings import NegotiationSettings
from .negotiation import Agreement, Negotiation
from .part_output import require_block, require_estimate, smoothed


class Strategy(ABC):
    """Renegotiates once a period and holds the agreed primitive in between.

    Every control step the measured wrench goes through the front end to the observer; once a
    period `agree` decides. Every strategy logs the same estimates, whether it uses them or not.

    Parameters
    ----------
    negotiation : NegotiationSettings
    front_end : FrontEnd
        Cleans the measured wrench at the sensor's rate.
    observer : Observer
        Reads stubbornness and wish from it.
    smoother : Smoother
        A copy of it smooths the logged stubbornness; what else it smooths is the strategy's.

    Attributes
    ----------
    columns : mapping of str to str
        Units, by name, of numbers that `Agreement.extras` brings; a class declares its own, an
        object has its observer's as well. They become columns of the trace.

    Raises
    ------
    InputError
        If the settings are of another kind, a part lacks a method, or the observer adds a column
        that the strategy adds too.
    """

    columns: Mapping[str, str] = MappingProxyType({})

    def __init__(
        self,
        negotiation: NegotiationSettings | None = None,
        front_end: FrontEnd | None = None,
        observer: Observer | None = None,
        smoother: Smoother | None = None,
    ) -> None:
        if negotiation is not None:
            require_instance("negotiation", negotiation, NegotiationSettings)
        parts = {"front_end": front_end, "observer": observer, "smoother": smoother}
        for name, given in parts.items():
            if given is not None:
                require_part(name, given, f"the {name}", ("reset", "update"))
        self.negotiation = negotiation or NegotiationSettings()
        self.front_end: FrontEnd = front_end or NoFrontEnd()
        self.observer: Observer = observer or PaperObserver()
        self.smoother: Smoother = smoother or MovingAverage()
        self._stubbornness_smoother = deepcopy(self.smoother)
        added = getattr(self.observer, "columns", {})
        require(
            isinstance(added, Mapping), ("observer", "columns"), added, "units by name are expected"
        )
        if twice := sorted(self.columns.keys() & added.keys()):
            what = f"the strategy adds a column {twice[0]!r} too; give one of them another name"
            raise InputError(f"observer.columns: {what}", ("observer", "columns"))
        self.columns = {**self.columns, **added}

    @abstractmethod
    def agree(self, negotiation: Negotiation) -> Agreement:
        """Return the primitive to execute until the next negotiation, and why."""

    def reset(self, rng: np.random.Generator, situation: Situation) -> None:
        """See `Automation.reset`."""
        settings = self.negotiation
        self._steps = settings.steps(situation.period)
        self._situation = situation
        self._reading = ForceReading(
            force_max=np.asarray(settings.force_max, dtype=float),
            force_threshold=np.asarray(settings.force_threshold, dtype=float),
            sensitivity=np.asarray(settings.sensitivity, dtype=float),
            period=settings.period,
            window=settings.force_window,
        )
        self._negotiated = slice(0 if settings.dimensions == "both" else 1, 2)
        self.front_end.reset(situation.rates)
        self.observer.reset(situation, self._reading, rng.spawn(1)[0])
        self._count = 0
        self._belief = Belief()
        self._twist = np.zeros(2)
        self._estimated: Estimate | None = None

    def act(self, observation: Observation) -> Array:
        """See `Automation.act`."""
        negotiating = self._count % self._steps == 0
        if negotiating:
            settings, pose = self.negotiation, observation["pose_world"]
            self._problem = PROBLEMS[settings.dimensions](settings, self._situation, pose)
            self._own = self._problem.wish()
            self._told = self._own.copy()
            self._told.flags.writeable = False  # what an observer hears is not its to change
        estimate = self._estimate(observation)
        if negotiating:
            self._negotiate(observation, estimate)
        elif estimate is not self._estimated:
            self._note(estimate)
        self._estimated = estimate
        self._count += 1
        return self._twist

    def belief(self) -> Belief:
        """See `Automation.belief`."""
        return self._belief

    def _estimate(self, observation: Observation) -> Estimate:
        """Return what the observer makes of what the front end made of the last control step."""
        measured, valid = observation["wrench"], observation["force_valid"]
        wrench = self.front_end.update(measured, valid)
        require_block(self.front_end, wrench, measured.shape)
        sample = Sample(
            wrench=wrench,
            valid=valid,
            twist=observation["twist"],
            pose=observation["pose_world"],
            dt=self._situation.period,
            time=observation["time"][..., 0],
        )
        estimate = self.observer.update(sample, self._told)
        if estimate is not self._estimated:
            require_estimate(self.observer, estimate, observation["twist"].shape)
        return estimate

    def _negotiate(self, observation: Observation, estimate: Estimate) -> None:
        twist = observation["twist"]
        if self._count == 0:
            self._stubbornness_smoother.reset(np.zeros(twist.shape))
        agreed = self.agree(
            Negotiation(
                problem=self._problem,
                own=self._own,
                human=self._negotiable(estimate.wish),
                estimate=estimate,
                stubbornness=estimate.stubbornness[..., self._negotiated],
                observation=observation,
                situation=self._situation,
                time=observation["time"][..., 0],
                number=self._belief.negotiation,
            )
        )
        if not isinstance(agreed, Agreement):
            raise PartError(self, f"agree() gave {said(agreed)}; it must be an Agreement")
        self._twist = agreed.twist
        self._belief = Belief(
            stubbornness=estimate.stubbornness,
            stubbornness_deviation=estimate.stubbornness_deviation,
            stubbornness_smoothed=smoothed(self._stubbornness_smoother, estimate.stubbornness),
            human_wish=estimate.wish,
            human_wish_deviation=estimate.wish_deviation,
            wish=self._own,
            interaction=agreed.interaction,
            interaction_smoothed=agreed.interaction_smoothed,
            utility_loss=agreed.utility_loss,
            target_utility=agreed.target_utility,
            negotiation=self._belief.negotiation + 1,
            extras={**agreed.extras, **estimate.extras},
        )

    def _note(self, estimate: Estimate) -> None:
        """Let the belief follow the observer between negotiations."""
        before = self._belief
        self._belief = replace(
            before,
            stubbornness=estimate.stubbornness,
            stubbornness_deviation=estimate.stubbornness_deviation,
            human_wish=estimate.wish,
            human_wish_deviation=estimate.wish_deviation,
            extras={**before.extras, **estimate.extras},
        )

    def _negotiable(self, wish: Array) -> Array:
        """Return the human's wish with the usual pace where v is not negotiated."""
        if self.negotiation.dimensions == "both":
            return wish
        return np.stack((np.full_like(wish[..., 0], self._situation.pace), wish[..., 1]), axis=-1)
