"""The PettingZoo parallel environment: a human seat and an automation seat share a handle."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box, Dict

from ..basics.errors import InputError, SimulationError
from ..basics.motion import Array, TwistBounds
from ..basics.observation import Observation
from ..basics.path import Path
from ..basics.rates import Rates
from ..basics.seats import SEATS
from ..basics.validators import refusal
from ..plant.registry import build_plant
from ..sensor.parameters import SensorParameters
from ..sensor.presets import sensor_preset
from ..sensor.sensor import ForceSensor
from ..world.contact import blocked_start
from ..world.world import Corridor, World
from .actions import Actions
from .configuration import Configuration
from .perception import Perception, observation_space
from .resumable import CLOSED
from .reward import NO_TERMS, Reward, RewardParameters, reward_parameters
from .steering import as_pushed
from .watched import WatchedEnv

STRAIGHT_CORRIDOR = World(path=Path(((0.0, 0.0), (20.0, 0.0))), corridor=Corridor(width=3.0))
"""The world of `parallel_env` without arguments: nothing in it, nothing to negotiate."""

Flags = dict[str, bool]
Stepped = tuple[dict[str, Observation], dict[str, float], Flags, Flags, dict[str, dict[str, Any]]]
"""By seat: observations, rewards, whether terminated, whether truncated, infos."""

_ENDS = ("goal", "collision", "grip_lost", "footing_lost")


class CowalkEnv(WatchedEnv):
    """Human and automation walk one base; each is an agent, both act once a control step.

    The human's action is the intended hand force on the base ``[fx, fy]``, base axes, N, a
    sideways one with the sign of the turn that it asks for (`cowalk.sim.env.steering`); the
    automation's is the twist to execute ``[v, omega]``, m/s and rad/s. Actions beyond the
    action space are clipped to it. Both seats perceive the same dict of named boxes: ``twist``
    (2,), ``force`` (samples, 2), ``wrench`` (samples, 6), ``force_valid`` (samples,), ``pose``
    (3,) relative to the path, ``pose_world`` (3,), ``obstacles`` (8, 6) and ``time`` (1,), as
    `cowalk.sim.basics.observation.Observation` explains.
    Spaces do not depend on who sits in the seats.

    Rewards are those of `cowalk.sim.env.reward.Reward`. An episode terminates when the base
    reaches the end of the path (``goal``), a body touches something solid (``collision``) or
    the plant asks for it, the grip (``grip_lost``) or the human's footing (``footing_lost``)
    being lost. It is truncated after ``duration``. Infos hold what a scoring needs and no seat
    may see.

    A copied or pickled environment is one of its own (see `cowalk.sim.env.resumable`).

    Parameters
    ----------
    world : World
    plant : str
        Registered plant or ``module:Class``.
    plant_parameters : dict, optional
        Further arguments of the plant's constructor.
    rates : Rates
    sensor : SensorParameters or str
        Or the name of a preset.
    bounds : TwistBounds
        Bounds of the automation's action.
    pace : float
        Usual walking speed, m/s; the rewards refer to it.
    duration : float
        Time after which an episode is truncated, s.
    force_limit : float
        Bound of the human's action, N. People communicate with up to 30 N
        (s41598-024-53991-4).
    reward : RewardParameters or mapping
        What the seats are rewarded for; a mapping gives some of its values.
    start : {"pace", "standing"}
        Whether all walk along at the pace when an episode begins, or stand.
    render_mode : {None, "rgb_array", "human"}

    Raises
    ------
    InputError
        If the plant, one of its parameters or the sensor is unknown, or a value makes no sense.
    """

    metadata: ClassVar[dict[str, Any]] = {
        "name": "cowalk_v0",
        "render_modes": ["human", "rgb_array"],
        "is_parallelizable": True,
        "render_fps": 20,
    }

    def __init__(
        self,
        world: World = STRAIGHT_CORRIDOR,
        *,
        plant: str = "bullet",
        plant_parameters: dict[str, Any] | None = None,
        rates: Rates = Rates(),
        sensor: SensorParameters | str = SensorParameters(),
        bounds: TwistBounds = TwistBounds(),
        pace: float = 0.8,
        duration: float = 30.0,
        force_limit: float = 30.0,
        reward: RewardParameters | Mapping[str, Any] = RewardParameters(),
        start: str = "pace",
        render_mode: str | None = None,
    ) -> None:
        if isinstance(sensor, str):
            try:
                sensor = sensor_preset(sensor)
            except InputError as error:
                raise error.inside("sensor") from error
        own = {} if plant_parameters is None else plant_parameters
        earned = reward_parameters(reward)
        self._configuration = given = Configuration(
            world, plant, own, rates, sensor, bounds, pace, duration, force_limit, earned, start
        )
        self.world, self.rates, self.bounds, self.pace = world, rates, bounds, pace
        self.force_limit = force_limit
        self.steps_per_episode = given.steps
        modes = self.metadata["render_modes"]
        if not (render_mode is None or (isinstance(render_mode, str) and render_mode in modes)):
            raise refusal("render_mode", render_mode, "known: None, human, rgb_array")
        self.render_mode = render_mode
        watched = render_mode == "human"
        self._plant, shown = build_plant(plant, rates, own, watched)
        self._window_needed = watched and not shown
        self.possible_agents = list(SEATS)
        self.agents: list[str] = []
        self._actions = Actions(bounds, force_limit)
        self.action_spaces = self._actions.spaces
        self.observation_spaces = dict.fromkeys(SEATS, observation_space(rates.samples))
        self._distances = self._plant.distances(world)
        self._reward = Reward(pace, rates.period, earned)
        self._from_behind = self._plant.steers_from_behind
        self._perceive = Perception(world, self._plant.bodies, rates.samples, self._from_behind)
        self._sensor = ForceSensor(sensor, rates.sensor)
        self._generator = np.random.default_rng()
        self._step_count = 0
        self._started = self._closed = False
        self.applied = (0.0, 0.0), (0.0, 0.0)
        """Force on the base (N, base axes) and twist (m/s, rad/s) of the last step, clipped."""
        self.felt = 0.0, 0.0
        """Executed twist that both seats saw before the last step, m/s and rad/s."""
        self._terms = NO_TERMS

    def observation_space(self, agent: str) -> Dict:
        """Return the observation space of a seat: the same for both."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Box:
        """Return the action space of a seat."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Observation], dict[str, dict[str, Any]]]:
        """Start an episode.

        Parameters
        ----------
        seed : int, optional
            Seed of all randomness of the environment; without one it goes on from the last.
        options : dict, optional
            Not used.

        Raises
        ------
        InputError
            If a body starts in touch with something solid, or what hangs on the sensor at rest
            is beyond its range.
        SimulationError
            If the environment is closed.
        """
        if self._closed:
            raise SimulationError(CLOSED)
        if seed is not None:
            self._generator = np.random.default_rng(seed)
        plant_rng, sensor_rng = self._generator.spawn(2)
        self.agents, self._started = [], False  # until nothing can be refused any more
        self._step_count = 0
        self._terms = NO_TERMS
        state = self._state = self._plant.reset(
            self.world, plant_rng, self._configuration.initial_twist
        )
        self._sensor.reset(sensor_rng, state.wrench_on_base[-1], state.mount)
        self._reading = self._sensor.measure(state.wrench_on_base, state.mount)
        clearance, touching = self._distances(self._time, *state.poses)
        if touching:
            plant = self._plant
            raise InputError(blocked_start(self.world, plant.bodies, state.poses, plant.distances))
        self.agents, self._started = list(SEATS), True
        self._relative = self.world.path.relative(*state.pose)
        self._info = {"clearance": clearance} | dict.fromkeys(_ENDS, False)
        return self._observations(), {seat: dict(self._info) for seat in SEATS}

    def step(self, actions: dict[str, Array]) -> Stepped:
        """Advance one control period.

        Parameters
        ----------
        actions : dict of ndarray, shape (2,)
            ``"human"``: intended hand force, N; ``"automation"``: twist, m/s and rad/s.

        Raises
        ------
        SimulationError
            If an action is missing or not finite, no episode is under way, or the plant cannot
            go on.
        """
        if not self.agents:
            what = "no episode is under way: call reset before step"
            raise SimulationError(CLOSED if self._closed else what)
        force, twist = self._actions.of_both(actions, self._time)
        force = as_pushed(force, self._from_behind)
        self.applied, self.felt = (force, twist), self._state.twist
        state = self._state = self._plant.step(twist, force)
        self._step_count += 1
        self._relative = self.world.path.relative(*state.pose)
        clearance, collision = self._distances(self._time, *state.poses)
        goal = self._relative[0] >= self.world.path.length
        ends = goal, collision, not state.grip_held, not state.footing_held
        self._info = {"clearance": clearance} | dict(zip(_ENDS, ends, strict=True))
        terms = self._reward.terms(state, self._relative, clearance, collision, goal)
        self._terms, rewards = terms, self._reward.of_each_seat(terms)
        # What has happened is known by now; here is what the seats get to know of it.
        self._reading = self._sensor.measure(state.wrench_on_base, state.mount)
        observations = self._observations()
        over = goal or collision or state.end is not None
        late = not over and self._step_count >= self.steps_per_episode
        if over or late:
            self.agents = []
        if self._window_needed:
            self.render()
        ended, cut = dict.fromkeys(SEATS, over), dict.fromkeys(SEATS, late)
        return observations, rewards, ended, cut, {seat: dict(self._info) for seat in SEATS}

    def close(self) -> None:
        """Free the plant. May be called twice."""
        self._closed, self.agents = True, []
        self._plant.close()

    @property
    def _time(self) -> float:
        """Since reset, s."""
        return self._step_count / self.rates.control

    def _observations(self) -> dict[str, Observation]:
        return self._perceive(self._state, self._reading, self._relative, self._time)


def parallel_env(world: World = STRAIGHT_CORRIDOR, **arguments: Any) -> CowalkEnv:
    """Return a `CowalkEnv` of its arguments; without any, a straight corridor, noise off."""
    return CowalkEnv(world, **arguments)
