"""What stands in an engine world that is looked at: cameras, pictures, every shape and its place.

It knows nothing about who stands there, so it serves whatever is loaded.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..basics.frames import Vector
from ..engine.engine import engine
from .camera import Camera
from .shapes import Place, Quaternion, Shape

LIGHT = (-2.0, 3.0, 6.0)
"""Where the light comes from, world axes."""

_KINDS = {
    engine.GEOM_BOX: "box",
    engine.GEOM_SPHERE: "sphere",
    engine.GEOM_CYLINDER: "cylinder",
    engine.GEOM_CAPSULE: "capsule",
    engine.GEOM_MESH: "mesh",
}


def look_at(
    target: Vector,
    distance: float,
    yaw: float,
    pitch: float,
    field: float,
    size: tuple[int, int],
) -> Camera:
    """Return a camera that looks at a point.

    Parameters
    ----------
    target : (x, y, z)
        World axes, m.
    distance : float
        From there, m. Seen is what lies up to 30 m behind it.
    yaw, pitch : float
        Degrees, as the engine counts them: at yaw -90 it looks along world x, at pitch -90 down.
    field : float
        Vertical field of view, degrees.
    size : (width, height)
        Of the picture, pixels.
    """
    width, height = size
    view = engine.computeViewMatrixFromYawPitchRoll(target, distance, yaw, pitch, 0.0, 2)
    projection = engine.computeProjectionMatrixFOV(
        field, width / height, max(0.1, 0.5 * (distance - 3.0)), distance + 30.0
    )
    # The engine stores matrices by columns.
    return Camera(np.reshape(view, (4, 4)).T, np.reshape(projection, (4, 4)).T, width, height)


def photograph(
    client: int, camera: Camera, behind: Image.Image, flat: Collection[int] = ()
) -> tuple[Image.Image, Image.Image]:
    """Return what a camera sees, rendered in software.

    Parameters
    ----------
    client : int
    camera : Camera
    behind : Image
        What is seen where no body is, RGB; changed in place.
    flat : collection of int
        Bodies that lie on the floor.

    Returns
    -------
    picture : Image
        RGB.
    upright : Image
        Mask of where a body is seen that does not lie on the floor: it hides what is drawn there.
    """
    _, _, pixels, _, seen = engine.getCameraImage(
        camera.width,
        camera.height,
        camera.view.T.ravel().tolist(),
        camera.projection.T.ravel().tolist(),
        lightDirection=LIGHT,
        shadow=0,
        renderer=engine.ER_TINY_RENDERER,
        physicsClientId=client,
    )
    size = (camera.height, camera.width)
    body = np.reshape(np.asarray(seen), size)
    something = body >= 0
    rendered = Image.fromarray(np.reshape(np.asarray(pixels, dtype=np.uint8), (*size, 4)))
    behind.paste(rendered.convert("RGB"), mask=Image.fromarray(_opaque(something)))
    for uid in flat:
        something &= body != uid
    return behind, Image.fromarray(_opaque(something))


def _opaque(where: NDArray[np.bool_]) -> NDArray[np.uint8]:
    return where.view(np.uint8) * np.uint8(255)


class Scene:
    """Every visible part of an engine world.

    Parameters
    ----------
    client : int
        The engine world. What is loaded into it later is not seen.
    """

    def __init__(self, client: int) -> None:
        self._client = client
        self._links: dict[tuple[int, int], str] = {}
        self.shapes: list[Shape] = []
        """What is to be seen."""
        for index in range(engine.getNumBodies(client)):
            body = engine.getBodyUniqueId(index, client)
            for shape in engine.getVisualShapeData(body, physicsClientId=client):
                self._add(body, *shape[1:8])

    def _add(
        self,
        body: int,
        link: int,
        kind: int,
        size: Vector,
        file: bytes,
        position: Vector,
        orientation: Quaternion,
        colour: tuple[float, float, float, float],
    ) -> None:
        if (body, link) not in self._links:
            self._links[body, link] = self._name(body, link)
        part, place = self._links[body, link], (position, orientation)
        self.shapes.append(Shape(part, _KINDS[kind], size, place, colour, file.decode()))

    def _name(self, body: int, link: int) -> str:
        client = self._client
        root, name = (text.decode() for text in engine.getBodyInfo(body, client))
        if not name:
            return f"scenery/{body}"
        part = engine.getJointInfo(body, link, client)[12].decode() if link >= 0 else root
        named = f"{name}/{part}"
        return f"{name}-{body}/{part}" if named in self._links.values() else named

    def places(self) -> dict[str, Place]:
        """Return where each part's frame is now, world axes."""
        client, found = self._client, {}
        for (body, link), name in self._links.items():
            if link >= 0:
                found[name] = tuple(engine.getLinkState(body, link, 0, 1, client)[4:6])
            else:  # the engine gives the centre of mass instead of the frame
                centre = engine.getBasePositionAndOrientation(body, client)
                inertial = engine.getDynamicsInfo(body, -1, client)[3:5]
                found[name] = engine.multiplyTransforms(*centre, *engine.invertTransform(*inertial))
        return found
