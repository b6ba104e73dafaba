"""Pictures of the PyBullet plant: the same bodies posed in a world that is only looked at.

The physics has a world of its own, without pictures or scenery, and pays nothing for being
watched; a run is the same whether or not anybody looks.
"""

from __future__ import annotations

import math
import time

import numpy as np
from numpy.typing import NDArray

from .bullet_engine import connect, disconnect, engine, load
from .bullet_scenery import Scenery
from .world import World

CAMERA_DISTANCE, CAMERA_PITCH, CAMERA_SIDE = 3.3, -24.0, 32.0
"""Chase camera: m, degrees, and degrees to the left of straight behind the base."""


class Viewer:
    """Scenery, base and human, seen by a chase camera.

    Parameters
    ----------
    world : World
    gui : bool
        Open a window; else pictures are rendered in software.

    Raises
    ------
    InputError
        If the window cannot be opened.
    """

    def __init__(self, world: World, gui: bool = False) -> None:
        self.world = world
        self._gui = gui
        self._target = (0.0, 0.0, 0.8)
        self._yaw = 0.0
        self._shown = 0.0
        self._client = connect(gui)
        if gui:
            engine.configureDebugVisualizer(engine.COV_ENABLE_GUI, 0, physicsClientId=self._client)
            engine.configureDebugVisualizer(
                engine.COV_ENABLE_RENDERING, 0, physicsClientId=self._client
            )
        self._bodies = [self._load("base.urdf"), self._load("human.urdf")]
        self._scenery = Scenery(self._client, world)
        if gui:
            engine.configureDebugVisualizer(
                engine.COV_ENABLE_RENDERING, 1, physicsClientId=self._client
            )

    def _load(self, file: str) -> tuple[int, list[int]]:
        body = load(self._client, file)
        moving = [
            joint
            for joint in range(engine.getNumJoints(body, self._client))
            if engine.getJointInfo(body, joint, self._client)[2] != engine.JOINT_FIXED
        ]
        return body, moving

    def show(self, base: tuple[float, ...], human: tuple[float, ...], now: float) -> None:
        """Pose the bodies and let the camera follow.

        Parameters
        ----------
        base : (x, y, yaw)
            Joint positions, world axes, m and rad.
        human : (x, y, yaw, shoulder, elbow)
            Joint positions, m and rad.
        now : float
            Since reset, s.
        """
        self._scenery.show(now)
        for (body, moving), angles in zip(self._bodies, (base, human), strict=True):
            for joint, angle in zip(moving, angles, strict=True):
                engine.resetJointState(body, joint, angle, 0.0, self._client)
        self._target = ((base[0] + human[0]) / 2.0, (base[1] + human[1]) / 2.0, 0.8)
        self._yaw = math.degrees(base[2]) - 90.0 - CAMERA_SIDE
        if self._gui:
            engine.resetDebugVisualizerCamera(
                CAMERA_DISTANCE, self._yaw, CAMERA_PITCH, self._target, self._client
            )

    def wait(self, period: float) -> None:
        """Wait until a period (s) has passed since the last wait: a watcher wants real time."""
        time.sleep(max(0.0, self._shown + period - time.perf_counter()))
        self._shown = time.perf_counter()

    def picture(self, width: int, height: int) -> NDArray[np.uint8]:
        """Return what the chase camera sees, uint8, shape (height, width, 3)."""
        view = engine.computeViewMatrixFromYawPitchRoll(
            self._target, CAMERA_DISTANCE, self._yaw, CAMERA_PITCH, 0.0, 2
        )
        projection = engine.computeProjectionMatrixFOV(50.0, width / height, 0.1, 30.0)
        pixels = engine.getCameraImage(
            width,
            height,
            view,
            projection,
            lightDirection=(-2.0, 3.0, 6.0),
            shadow=0,
            renderer=engine.ER_TINY_RENDERER,
            physicsClientId=self._client,
        )[2]
        return np.reshape(np.array(pixels, dtype=np.uint8), (height, width, 4))[..., :3].copy()

    def close(self) -> None:
        """Free the world. May be called twice."""
        disconnect(self._client)
