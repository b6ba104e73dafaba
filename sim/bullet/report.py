"""What the plant says of its bodies after a control step."""

from __future__ import annotations

import math

from ..basics.motion import Array
from ..body.walker import Walker
from ..plant.protocol import PlantState
from ..sensor.wrench import SensorMount
from .pair import Pair


def report(
    pair: Pair,
    walker: Walker,
    ends: bool,
    mount: SensorMount,
    wrench: Array,
    work: float,
    time: float,
) -> PlantState:
    """Return the state of a pair.

    Parameters
    ----------
    pair : Pair
    walker : Walker
    ends : bool
        Whether a lost grip ends the episode.
    mount, wrench, work, time
        See `PlantState`.

    Raises
    ------
    SimulationError
        If the bodies move as none does.
    """
    pair.refuse_divergence()
    x, y, yaw, vx, vy, rate = pair.base_state
    human, load = pair.human_state, pair.load_state
    end = "grip lost" if ends and not pair.hands.held else None
    return PlantState(
        pose=(x, y, yaw),
        twist=(math.cos(yaw) * vx + math.sin(yaw) * vy, rate),
        human_pose=(human[0], human[1], human[2]),
        wrench_on_base=wrench,
        mount=mount,
        grip_held=pair.hands.held,
        footing_held=walker.footing.held,
        end="lost footing" if walker.footing.over else end,
        time=time,
        load_pose=(load[0], load[1], load[2]) if load else None,
        work=work,
        drive=pair.mean_drive(),
    )
