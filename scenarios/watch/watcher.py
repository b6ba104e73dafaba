"""Who watches a run: told of every control step, changing nothing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np

from cowalk.sim.basics.errors import SimulationError
from cowalk.sim.basics.motion import Array, arc_displacement, compose

if TYPE_CHECKING:
    from cowalk.sim.env.env import CowalkEnv
    from cowalk.sim.view.viewer import Viewer

    from ..files.schema import Scenario
    from ..trace.trace import Trace


class Watcher(Protocol):
    """Sees a run from its start to its end; called by `cowalk.scenarios.run`."""

    def start(self, scenario: Scenario, env: CowalkEnv) -> None:
        """Prepare; the environment stands at its reset.

        Raises
        ------
        InputError
            If what is to be written cannot be.
        """
        ...

    def step(self, env: CowalkEnv, trace: Trace) -> None:
        """Look at the environment after a control step; the trace's last row tells of it.

        Raises
        ------
        SimulationError
            If watching cannot go on; the run then ends with what it has.
        """
        ...

    def close(self) -> None:
        """Finish. Called once, however the run ends, and even if it never started."""
        ...


@runtime_checkable
class Filmed(Protocol):
    """A plant whose bodies stand in an engine world that can be looked at."""

    @property
    def handle(self) -> tuple[float, float, float]:
        """Where the handle is, base axes, m."""

    def viewer(self) -> Viewer:
        """Return what shows the plant as it is now."""


def arc_points(pose: Array, twist: Array, horizon: float, count: int = 24) -> Array:
    """Return points of the arc that a twist held over a horizon leads along.

    Parameters
    ----------
    pose : ndarray, shape (3,)
        Where it starts, world axes, m, m, rad.
    twist : ndarray, shape (2,)
        m/s and rad/s.
    horizon : float
        s.
    count : int
        Number of points.

    Returns
    -------
    ndarray, shape (count, 3)
        World x, y (m) and heading (rad); NaN for an unknown twist.
    """
    times = np.linspace(0.0, horizon, count)
    return compose(pose, arc_displacement(np.broadcast_to(twist, (count, 2)), times))


def close_all(watchers: Sequence[Watcher]) -> str | None:
    """Close every watcher; return what the last of those that failed says."""
    said = None
    for watcher in watchers:
        try:
            watcher.close()
        except SimulationError as failure:
            said = str(failure)
    return said
