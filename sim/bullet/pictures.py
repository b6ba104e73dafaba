"""A pair of bodies shown in a world of its own, which is made when somebody first looks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..world.world import World
from .pair import Pair

if TYPE_CHECKING:
    from ..view.viewer import Viewer


class Pictures:
    """The viewer of a plant, if anybody has looked.

    Parameters
    ----------
    gui : bool
        Whether it opens a window.
    """

    def __init__(self, gui: bool) -> None:
        self._gui = gui
        self._viewer: Viewer | None = None

    def of(self, world: World, pair: Pair, phase: float | None, time: float) -> Viewer:
        """Return what shows a pair in a world, posed as it is.

        Parameters
        ----------
        world : World
        pair : Pair
        phase : float or None
            Of the gait, rad, if there is one.
        time : float
            Since reset, s.
        """
        if self._viewer is None or self._viewer.world != world:
            self.close()
            # Slow to import, with what it draws by; most runs are not looked at.
            from ..view.viewer import Viewer

            self._viewer = Viewer(world, pair.look, self._gui)
        x, y, yaw, vx, vy, _ = pair.base_state
        joints = pair.human_state[: len(pair.human_state) // 2]
        speed = math.cos(yaw) * vx + math.sin(yaw) * vy
        self._viewer.show((x, y, yaw), joints, pair.load_state[:3], phase, speed, time)
        return self._viewer

    def close(self) -> None:
        """Free the viewer. May be called twice."""
        if self._viewer is not None:
            self._viewer.close()
            self._viewer = None
