"""The engine world that all distances of a process share: one takes 28 MB.

The engine is asked about pairs of bodies alone, so others beside them change no distance.
"""

from __future__ import annotations

import threading
from typing import Any

from ..engine.engine import connect, engine


class SharedWorld:
    """An engine world that is opened when somebody first needs it, and emptied by the last.

    Attributes
    ----------
    lock : threading.RLock
        Held by who asks the engine something in this world: runs may go on in several threads.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self._client = -1
        self._users = 0
        self._shapes: dict[tuple[Any, ...], int] = {}

    def enter(self) -> int:
        """Return its client."""
        with self.lock:
            if not engine.isConnected(self._client):
                self._client, self._users, self._shapes = connect(), 0, {}
            self._users += 1
            return self._client

    def shape(self, kind: int, **arguments: Any) -> int:
        """Return a shape for who has entered: made once, as the engine frees no used one."""
        wanted = (kind, *arguments.items())
        with self.lock:
            if wanted not in self._shapes:
                self._shapes[wanted] = engine.createCollisionShape(
                    kind, physicsClientId=self._client, **arguments
                )
            return self._shapes[wanted]

    def leave(self, client: int, bodies: list[int]) -> None:
        """Take bodies away; the last one empties it, which frees what removing leaves behind."""
        with self.lock:
            if client != self._client or not engine.isConnected(client):
                return
            self._users -= 1
            if not self._users:
                engine.resetSimulation(physicsClientId=client)
                self._shapes = {}
                return
            for body in bodies:
                engine.removeBody(body, physicsClientId=client)


SHARED = SharedWorld()
