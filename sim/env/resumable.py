"""An environment that can be saved, restored, copied and pickled within an episode."""

from __future__ import annotations

import copy
from abc import abstractmethod
from typing import Any

from pettingzoo import ParallelEnv

from ..basics.errors import SimulationError
from ..basics.motion import Array
from ..basics.observation import Observation
from ..plant.protocol import Plant
from .configuration import Configuration
from .snapshot import Snapshot, matching

CHANGING = (
    "agents",
    "applied",
    "felt",
    "_step_count",
    "_sensor",
    "_generator",
    "_state",
    "_reading",
    "_relative",
    "_info",
    "_terms",
)
"""What of an environment changes within an episode, beside its plant."""

CLOSED = "this environment is closed: make a new one"


class ResumableEnv(ParallelEnv[str, Observation, Array]):
    """An environment whose whole state is its plant's and what `CHANGING` names.

    A copied or pickled one is made anew with the same arguments and goes on from the state of
    the original, bit for bit. Neither disturbs the other. It opens no window. With the drive
    "wheels" the engine keeps the state: then it is refused from the first reset on.
    """

    render_mode: str | None
    _configuration: Configuration
    _plant: Plant
    _started: bool
    _closed: bool

    def save(self) -> Snapshot:
        """Return the whole state within an episode, for `restore`: opaque, and never changed.

        Raises
        ------
        SimulationError
            If there was no `reset` yet, or the environment is closed.
        """
        self._require("save", opened=True)
        return Snapshot(self._configuration, self._plant.save(), self._changing())

    def restore(self, saved: Snapshot) -> dict[str, Observation]:
        """Go on from a saved state, bit for bit; return what is seen there.

        It may come from another environment that was made with the same arguments, ``render_mode``
        aside; not with the drive "wheels", where the engine keeps it.

        Raises
        ------
        InputError
            If it is the state of an environment that was made otherwise.
        SimulationError
            If this environment is closed.
        """
        if self._closed:
            raise SimulationError(CLOSED)
        saved = matching(saved, self._configuration)
        self._plant.restore(saved.plant)
        self.__dict__.update(copy.deepcopy(dict(saved.own)))
        self._started = True
        return self._observations()

    def __getstate__(self) -> dict[str, Any]:
        """Return what a copy is made from."""
        running = self._started and not self._closed
        return {
            "configuration": self._configuration,
            # Two windows cannot be open, and nobody watches a look ahead.
            "render_mode": None if self.render_mode == "human" else self.render_mode,
            "plant": self._plant.save() if running else None,
            "own": self._changing(),
            "started": self._started,
            "closed": self._closed,
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Become a copy."""
        given = vars(state["configuration"])
        made: Any = type(self).__init__  # that of the environment, which takes them all
        made(self, **given, render_mode=state["render_mode"])
        if state["plant"] is not None:
            self._plant.restore(state["plant"])
        self.__dict__.update(state["own"])
        self._started = state["started"]
        if state["closed"]:
            self.close()

    def __copy__(self) -> ResumableEnv:
        """Return what `copy.deepcopy` does: environments share no parts."""
        return copy.deepcopy(self)

    def _changing(self) -> dict[str, Any]:
        # Copied as one, so that what its parts share stays shared.
        present = {name: vars(self)[name] for name in CHANGING if name in vars(self)}
        return copy.deepcopy(present)

    @abstractmethod
    def _observations(self) -> dict[str, Observation]:
        """Return what the seats perceive now."""

    def _require(self, what: str, opened: bool = False) -> None:
        """Refuse what needs an episode, under way or over, and perhaps an open environment."""
        if self._closed and opened:
            raise SimulationError(CLOSED)
        if not self._started:
            raise SimulationError(f"no episode has begun: call reset before {what}")
