"""Who watches a run: told of every control step, changing nothing."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np

from cowalk.sim.basics.errors import InputError, SimulationError, told
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
            If watching cannot go on; the run does, without this watcher.
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


class Watchers:
    """All who watch a run; one that fails is left out from then on, and costs nothing else.

    Parameters
    ----------
    watchers : sequence of Watcher

    Attributes
    ----------
    lost : list of str
        What could not be shown or written, and why, a line each.
    """

    def __init__(self, watchers: Sequence[Watcher]) -> None:
        self.lost: list[str] = []
        self._watching = list(watchers)

    def start(self, scenario: Scenario, env: CowalkEnv) -> None:
        """See `Watcher.start`.

        Raises
        ------
        InputError
            If one cannot write what it is asked to: nothing is lost yet.
        """
        for watcher in tuple(self._watching):
            try:
                watcher.start(scenario, env)
            except InputError:
                raise
            except Exception as failure:
                self._leave_out(watcher, failure)

    def step(self, env: CowalkEnv, trace: Trace) -> None:
        """See `Watcher.step`."""
        for watcher in self._watching:  # a list that is never changed, only replaced
            try:
                watcher.step(env, trace)
            except Exception as failure:
                self._leave_out(watcher, failure)

    def close(self) -> None:
        """See `Watcher.close`; the second time nothing is left to close."""
        watching, self._watching = self._watching, []
        for watcher in watching:
            try:
                watcher.close()
            except Exception as failure:
                self._note(watcher, failure)

    def _leave_out(self, watcher: Watcher, failure: Exception) -> None:
        self._watching = [other for other in self._watching if other is not watcher]
        self._note(watcher, failure)
        with suppress(Exception):
            watcher.close()

    def _note(self, watcher: Watcher, failure: Exception) -> None:
        known = isinstance(failure, SimulationError | InputError)
        self.lost.append(
            str(failure) if known else f"watcher {type(watcher).__name__!r}: {told(failure)}"
        )
