"""The kinematic plant of the paper: the base is a unicycle that executes its command exactly."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..basics.errors import SimulationError
from ..basics.rates import Rates
from ..basics.validators import require_instance
from ..plant.discs import HUMAN_PLACE, PLAIN_BODIES
from ..plant.protocol import PlantState
from ..world.clearance import Clearance
from ..world.outline import Bodies
from ..world.world import World


class UnicyclePlant:
    """Unicycle integrated along exact arcs; the interaction force is the intended one.

    x' = v cos(theta), y' = v sin(theta), theta' = omega (Schneider et al., arXiv 2407.17275).
    The human is carried along at a fixed place beside the base.

    Parameters
    ----------
    rates : Rates

    Raises
    ------
    InputError
        If it is not given `Rates`.
    """

    steers_from_behind = False
    wheels = None

    def __init__(self, rates: Rates) -> None:
        require_instance("rates", rates, Rates)
        self._period = rates.period
        self._samples = rates.samples
        self._pose = (0.0, 0.0, 0.0)
        self._twist = (0.0, 0.0)
        self._hand_force = (0.0, 0.0)
        self._world: World | None = None
        self._steps = 0

    @property
    def bodies(self) -> Bodies:
        """See `Plant.bodies`: two discs."""
        return PLAIN_BODIES

    def reset(
        self, world: World, rng: np.random.Generator, twist: tuple[float, float] = (0.0, 0.0)
    ) -> PlantState:
        """See `Plant.reset`."""
        self._world = world
        self._pose = world.start
        self._steps = 0
        self._twist = float(twist[0]), float(twist[1])
        self._hand_force = (0.0, 0.0)
        return self._state()

    def step(
        self, twist_command: tuple[float, float], hand_force: tuple[float, float]
    ) -> PlantState:
        """See `Plant.step`."""
        v, omega = float(twist_command[0]), float(twist_command[1])
        x, y, theta = self._pose
        half = omega * self._period / 2.0
        chord = v * self._period * (math.sin(half) / half if abs(half) > 1e-9 else 1.0)
        self._pose = (
            x + chord * math.cos(theta + half),
            y + chord * math.sin(theta + half),
            theta + 2.0 * half,
        )
        self._twist = (v, omega)
        self._steps += 1
        self._hand_force = hand_force
        if not math.isfinite(sum(self._pose)):
            raise SimulationError(f"the base's pose is {self._pose}: not finite")
        return self._state()

    def save(self) -> Any:
        """See `Plant.save`."""
        return self._pose, self._twist, self._hand_force, self._world, self._steps

    def restore(self, saved: Any) -> PlantState:
        """See `Plant.restore`."""
        self._pose, self._twist, self._hand_force, self._world, self._steps = saved
        return self._state()

    def _state(self) -> PlantState:
        x, y, theta = self._pose
        cos, sin = math.cos(theta), math.sin(theta)
        place_x, place_y, place_theta = HUMAN_PLACE
        wrench = np.zeros((self._samples, 6))  # there is no body to have a torque
        wrench[:, 0], wrench[:, 1] = self._hand_force
        return PlantState(
            pose=self._pose,
            twist=self._twist,
            human_pose=(
                x + cos * place_x - sin * place_y,
                y + sin * place_x + cos * place_y,
                theta + place_theta,
            ),
            wrench_on_base=wrench,
            time=self._steps * self._period,
            # The force acts at the centre, which moves along the arc.
            work=self._hand_force[0] * self._twist[0] * self._period if self._steps else 0.0,
        )

    def distances(self, world: World) -> Clearance:
        """See `Plant.distances`: in closed form."""
        return Clearance(world, PLAIN_BODIES.parts)

    def render(self, width: int, height: int) -> np.ndarray:
        """See `Plant.render`: a drawing from above."""
        # Matplotlib takes a while to import; whoever does not look need not wait for it.
        from ..view.top_view import draw

        assert self._world is not None, "reset before render"
        return draw(self._world, self._state(), PLAIN_BODIES, width, height)

    def close(self) -> None:
        """See `Plant.close`: nothing is held."""
