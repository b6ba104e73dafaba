"""A scenario in which one seat is the learner's and the other somebody's, for Gymnasium."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.basics.errors import InputError, PartError, SimulationError
from cowalk.sim.basics.seats import SEATS
from cowalk.sim.basics.validators import require_flag, shown
from cowalk.sim.env.env import CowalkEnv
from cowalk.sim.env.reward import RewardParameters, reward_parameters

from ..files.loading import load
from ..files.schema import Scenario
from ..people.population import Population
from ..running.agent_output import require_force, require_twist
from ..running.build import make_env, seeds_of, situation_of
from .partners import SEEDS, Partners
from .spaces import LearnerAction, LearnerObservation


class SingleSeatEnv(gymnasium.Env[Any, Any]):
    """One seat of a scenario; a partner acts in the other through the same loop as in a run.

    A step is a control step. The reward is that of the seat (`cowalk.sim.env.reward.Reward`),
    an episode ends as `cowalk.sim.env.env.CowalkEnv` says. Infos hold ``clearance`` in m,
    whether ``goal``, ``collision``, ``grip_lost`` or ``footing_lost`` came, and ``reward_terms``,
    what each term added to the reward; that of a reset has the ``partner``'s name.

    ``reset(seed=n)`` starts the episode that ``cowalk run`` runs with the seed n. Without a seed
    the next one follows from the last: whoever seeds the first reset repeats all of them.

    `copy.deepcopy` and pickling give an environment of its own, its partner included.

    Parameters
    ----------
    scenario : str, Path or Scenario
        Name of one that ships, file, or one that is loaded.
    seat : {"automation", "human"}
        The learner's. Its action is the twist to execute, or the hand force.
    partner : str, agent or sequence of them, optional
        Who sits in the other seat: a registered name, ``module:Class`` or an agent that is built
        already; of a sequence one is drawn for each episode, all alike likely. Left out, it is
        the scenario's own.
    population : str, Path or Population, optional
        Instead of a partner: people of whom one is drawn for each episode, for the human seat.
    observation : {"flat", "dict"}
        One vector laid out as `layout` says, or a dict as in the PettingZoo environment.
    normalise : bool
        Observations in the scales of `cowalk.scenarios.single_seat.spaces.scales` and actions
        from -1 to 1 between the bounds of the seat, both float32; else SI units, float64.
    reward : RewardParameters or mapping, optional
        What the seats are rewarded for; left out, as the scenario says.
    render_mode : {None, "rgb_array"}

    Raises
    ------
    InputError
        If an argument is not right.
    """

    # Declared as Gymnasium does.
    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 20}  # noqa: RUF012

    def __init__(
        self,
        scenario: str | Path | Scenario,
        seat: str = "automation",
        partner: Any = None,
        population: str | Path | Population | None = None,
        observation: str = "flat",
        normalise: bool = True,
        reward: RewardParameters | Mapping[str, Any] | None = None,
        render_mode: str | None = None,
    ) -> None:
        if not isinstance(seat, str) or seat not in SEATS:
            raise InputError(f"seat = {shown(seat)}: must be one of {', '.join(SEATS)}", ("seat",))
        require_flag("normalise", normalise)
        modes = self.metadata["render_modes"]
        if not (render_mode is None or (isinstance(render_mode, str) and render_mode in modes)):
            what = f"render_mode = {shown(render_mode)}: must be rgb_array, or be left out"
            raise InputError(what, ("render_mode",))
        chosen = scenario if isinstance(scenario, Scenario) else load(scenario)
        if reward is not None:
            chosen = chosen.model_copy(update={"reward": reward_parameters(reward)})
        self._scenario = chosen
        self._seat, (self._other,) = seat, [other for other in SEATS if other != seat]
        self._partners = Partners(chosen, self._other, partner, population)
        self._perceive = LearnerObservation(chosen, observation, normalise)
        self.observation_space = self._perceive.space
        self._env = make_env(chosen, render_mode)
        self._act = LearnerAction(self._env.action_space(seat), normalise)
        self.action_space = self._act.space
        self.render_mode = render_mode
        self.metadata = {**self.metadata, "render_fps": chosen.rates.control}
        self._partner: Human | Automation | None = None
        self._seen: Any = None

    @property
    def scenario(self) -> Scenario:
        """The scenario, reward as given."""
        return self._scenario

    @property
    def parallel(self) -> CowalkEnv:
        """The PettingZoo environment in it: truth, for those who watch, not for a learner."""
        return self._env

    @property
    def partner(self) -> Human | Automation | None:
        """Who sits in the other seat in this episode; nobody before the first."""
        return self._partner

    @property
    def layout(self) -> dict[str, slice]:
        """Where each entry of `cowalk.sim.basics.observation.Observation` stands in a flat one."""
        return dict(self._perceive.layout)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Start an episode: draw the partner, reset it and the environment.

        Parameters
        ----------
        seed : int, optional
            Of all randomness of this episode and of those that follow without one.
        options : dict, optional
            Not used.

        Raises
        ------
        InputError
            If the scenario's start is blocked.
        SimulationError
            If the environment is closed, or the partner fails.
        """
        super().reset(seed=seed)
        episode = int(self.np_random.integers(SEEDS)) if seed is None else seed
        seeds = seeds_of(self._scenario.model_copy(update={"seed": episode}))
        # Spawned after those of a run, so that they stay as they are.
        drawing = np.random.default_rng(np.random.SeedSequence(episode).spawn(4)[3])
        name, self._partner = self._partners.draw(drawing)
        self._seen, infos = self._env.reset(seed=seeds.env)
        situation = situation_of(self._scenario, self._env)
        try:
            self._partner.reset(getattr(seeds, self._other), situation)
        except Exception as failure:  # a user's class may raise anything
            raise self._failed(failure) from failure
        return self._perceive(self._seen[self._seat]), {**self._info(infos), "partner": name}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Act for a control step, the partner too.

        Parameters
        ----------
        action : ndarray, shape (2,)
            Within `action_space`; beyond it, it is clipped.

        Raises
        ------
        SimulationError
            If the action is not two finite numbers, no episode is under way, the plant cannot
            go on, or the partner fails.
        """
        if self._partner is None:
            raise SimulationError("no episode has begun: call reset before step")
        actions = {self._seat: self._act(action)}
        if self._env.agents:
            actions[self._other] = self._answer()
        self._seen, rewards, over, late, infos = self._env.step(actions)
        seat = self._seat
        seen = self._perceive(self._seen[seat])
        return seen, rewards[seat], over[seat], late[seat], self._info(infos)

    def _answer(self) -> Any:
        """Return what the partner does."""
        assert self._partner is not None
        try:
            answer = self._partner.act(self._seen[self._other])
            (require_force if self._other == "human" else require_twist)(self._partner, answer)
        except Exception as failure:  # a user's class may raise anything
            raise self._failed(failure) from failure
        return answer

    def _failed(self, failure: Exception) -> SimulationError:
        kind = type(self._partner).__name__
        reason = (
            failure if isinstance(failure, PartError) else f"{type(failure).__name__}: {failure}"
        )
        return SimulationError(f"the {self._other} {kind!r} failed: {reason}")

    def _info(self, infos: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
        return {**infos[self._seat], "reward_terms": self._env.reward_terms[self._seat]}

    def render(self) -> Any:
        """Return a picture, uint8, shape (480, 640, 3), in mode ``"rgb_array"``, else None."""
        return self._env.render()

    def close(self) -> None:
        """Free the plant. May be called twice."""
        self._env.close()

    def __copy__(self) -> SingleSeatEnv:
        """Return what `copy.deepcopy` does: environments share no parts."""
        return copy.deepcopy(self)
