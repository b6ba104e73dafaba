"""Pictures of the PyBullet plant: the same bodies posed in a world that is only looked at.

The physics has a world of its own, without pictures or scenery, and pays nothing for being
watched; a run is the same whether or not anybody looks.
"""

from __future__ import annotations

import math
import shutil
import time
import weakref
from dataclasses import replace
from tempfile import mkdtemp

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..body.figure import figure_urdf, pose
from ..body.gait import step_frequency
from ..engine.engine import connect, engine, free_with, load
from ..robot.coupling import THICKNESS
from ..urdf.colours import one_colour_a_link
from ..urdf.meshes import copy_meshes
from ..world.world import World
from .camera import Camera
from .look import Look
from .scene import look_at, photograph
from .scenery import Scenery

CLOTH = (0.85, 0.80, 0.62, 1.0)
CAMERA_DISTANCE, CAMERA_PITCH, CAMERA_SIDE, CAMERA_FIELD = 3.3, -24.0, 32.0, 50.0
"""Chase camera: m, degrees, degrees to the left of straight behind the base, degrees. So far
away for a person of `CAMERA_SUITS`; for taller ones it backs off and looks higher."""
CAMERA_HEIGHT, CAMERA_SUITS = 0.8, 1.75
"""How high it looks, and the height of a person who fits into its picture with some air, m."""
LENGTH_SUITS = 1.2
"""Length of a load that does too, m: from longer ones it backs off by what they are longer."""
TOP_DISTANCE, TOP_FIELD, TOP_AHEAD = 24.0, 10.0, 0.8
"""Top camera, far away so that it hardly distorts: m, degrees, m ahead of the pair."""

COARSE_BEYOND, COARSENESS = 400, 0.8
"""Pictures wider than so many pixels are rendered smaller, by this factor on either side, and
enlarged: it saves a quarter of the time, and smooths edges."""


class Viewer:
    """Scenery, base and human, seen by a chase camera.

    Parameters
    ----------
    world : World
    look : Look
    gui : bool
        Open a window; else pictures are rendered in software.

    Raises
    ------
    InputError
        If the window cannot be opened.
    """

    def __init__(self, world: World, look: Look, gui: bool = False) -> None:
        self.world = world
        self._gui = gui
        scale = max(1.0, look.human.parameters.height / CAMERA_SUITS)
        self._aim, self._distance = scale * CAMERA_HEIGHT, scale * CAMERA_DISTANCE
        if look.load is not None:
            self._distance += max(0.0, look.load.length - LENGTH_SUITS)
        self._target = (0.0, 0.0, self._aim)
        self._yaw = 0.0
        self._shown = 0.0
        self._client = connect(gui)
        self._free = free_with(self, self._client)
        if gui:
            engine.configureDebugVisualizer(engine.COV_ENABLE_GUI, 0, physicsClientId=self._client)
            engine.configureDebugVisualizer(
                engine.COV_ENABLE_RENDERING, 0, physicsClientId=self._client
            )
        self._look = look
        robot = look.robot
        if "<mesh" in robot:
            folder = mkdtemp(prefix="cowalk-")  # for as long as somebody asks what is shown
            weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
            robot = copy_meshes(robot, folder)
        self._robot = load(self._client, one_colour_a_link(robot))
        self._human = load(self._client, one_colour_a_link(figure_urdf(look.human)))
        self._joints = {
            engine.getJointInfo(self._human, joint, self._client)[1].decode(): joint
            for joint in range(engine.getNumJoints(self._human, self._client))
        }
        self._carried = self._stretcher(look) if look.load else None
        self._walked: tuple[float, float] | None = None
        self._phase = 0.0
        self._scenery = Scenery(self._client, world, floor=gui)
        if gui:
            engine.configureDebugVisualizer(
                engine.COV_ENABLE_RENDERING, 1, physicsClientId=self._client
            )

    def _stretcher(self, look: Look) -> int:
        """Return a load of two poles and a cloth, its origin at the clamp on the floor."""
        assert look.load is not None
        length, width, height = look.load.length, look.load.width, look.clamp[2]
        pole = engine.createVisualShape(
            engine.GEOM_BOX,
            halfExtents=(length / 2.0, width / 2.0, THICKNESS / 2.0),
            rgbaColor=CLOTH,
            visualFramePosition=(-length / 2.0, 0.0, height),
            physicsClientId=self._client,
        )
        body: int = engine.createMultiBody(
            0.0, baseVisualShapeIndex=pole, physicsClientId=self._client
        )
        return body

    def show(
        self,
        base: tuple[float, ...],
        human: tuple[float, ...],
        carried: tuple[float, ...],
        phase: float | None,
        speed: float,
        now: float,
    ) -> None:
        """Pose the bodies and let the camera follow.

        Parameters
        ----------
        base : (x, y, yaw)
            World axes, m and rad.
        human : (x, y, yaw, shoulder, elbow, ...)
            Joint positions, m and rad.
        carried : (x, y, yaw) or ()
            Of the load.
        phase : float or None
            Of the stride, rad; None takes it from the distance walked since the last look.
        speed : float
            Of the walk, m/s.
        now : float
            Since reset, s.
        """
        self._scenery.show(now)
        self._put(self._robot, base)
        self._put(self._human, human)
        if self._carried is not None:
            self._put(self._carried, carried)
        if phase is None:
            phase = self._phase = self._stepped(human[:2], speed)
        body = self._look.human
        angles = dict(zip(body.joints[3:], human[3:], strict=True))
        angles |= pose(body.parameters, phase, speed)
        for name, angle in angles.items():
            if name in self._joints:
                engine.resetJointState(self._human, self._joints[name], angle, 0.0, self._client)
        self._target = ((base[0] + human[0]) / 2.0, (base[1] + human[1]) / 2.0, self._aim)
        self._yaw = math.degrees(base[2]) - 90.0 - CAMERA_SIDE
        if self._gui:
            engine.resetDebugVisualizerCamera(
                self._distance, self._yaw, CAMERA_PITCH, self._target, self._client
            )

    def _put(self, body: int, place: tuple[float, ...]) -> None:
        turn = engine.getQuaternionFromEuler((0.0, 0.0, place[2]))
        # The engine places the root link's centre of mass, not its frame.
        inertial = engine.getDynamicsInfo(body, -1, self._client)[3:5]
        centre = engine.multiplyTransforms((*place[:2], 0.0), turn, *inertial)
        engine.resetBasePositionAndOrientation(body, *centre, self._client)

    def _stepped(self, place: tuple[float, ...], speed: float) -> float:
        """Return the phase of the stride after walking here from where one was last seen."""
        last, self._walked = self._walked, (place[0], place[1])
        if last is None or speed < 0.05:
            return self._phase
        step = speed / step_frequency(speed)
        return self._phase + math.pi * math.dist(last, self._walked) / step

    def wait(self, period: float) -> None:
        """Wait until a period (s) has passed since the last wait: a watcher wants real time."""
        time.sleep(max(0.0, self._shown + period - time.perf_counter()))
        self._shown = time.perf_counter()

    @property
    def client(self) -> int:
        """The engine world that is looked at."""
        return self._client

    def camera(self, kind: str, width: int, height: int) -> Camera:
        """Return a camera that follows the pair.

        Parameters
        ----------
        kind : {"chase", "top"}
            From behind, or straight from above with world x to the right.
        width, height : int
            Size of the picture in pixels.
        """
        size = (width, height)
        if kind == "top":
            x, y, _ = self._target
            ahead = (x + TOP_AHEAD, 0.0 if self.world.corridor else y, 0.0)
            return look_at(ahead, TOP_DISTANCE, 0.0, -89.99, TOP_FIELD, size)
        return look_at(self._target, self._distance, self._yaw, CAMERA_PITCH, CAMERA_FIELD, size)

    def picture(self, width: int, height: int) -> NDArray[np.uint8]:
        """Return what the chase camera sees, uint8, shape (height, width, 3)."""
        return np.asarray(self.look(self.camera("chase", width, height))[0])

    def look(self, camera: Camera) -> tuple[Image.Image, Image.Image]:
        """Return what a camera sees, and the mask of what hides things drawn on the floor."""
        scenery, size = self._scenery, (camera.width, camera.height)
        if camera.width > COARSE_BEYOND:
            width, height = (round(COARSENESS * pixels) for pixels in size)
            camera = replace(camera, width=width, height=height)
        behind = scenery.floor.paint(camera)
        layers = photograph(self._client, camera, behind, scenery.flat)
        if camera.width == size[0]:
            return layers
        picture, upright = (layer.resize(size, Image.Resampling.BILINEAR) for layer in layers)
        return picture, upright

    def close(self) -> None:
        """Free the world. May be called twice."""
        self._free()
