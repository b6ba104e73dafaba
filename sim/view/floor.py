"""The tiled floor of a world that is looked at: as bodies of a window, or painted under a picture.

A floor fills most of a picture, and the engine's software renderer pays for every pixel: painting
it halves the time of a picture.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw

from ..basics.motion import Array
from ..engine.engine import engine
from ..world.world import World
from .camera import Camera

TILE = 1.0
"""Side of the floor's tiles, m: without them one cannot see that the pair moves."""
FLOOR, FLOOR_DARK = (0.80, 0.78, 0.74, 1.0), (0.74, 0.72, 0.68, 1.0)


PAINT, PAINT_DARK = (190, 184, 175), (175, 169, 160)
"""The same as the engine lights them, 0 to 255."""
NEAREST = 0.05
"""What is closer to the camera's plane is not seen, m."""
SKY_HIGH, SKY_LOW = np.array([198.0, 212.0, 224.0]), np.array([242.0, 244.0, 246.0])
"""Colours behind everything, at the upper and the lower edge of a picture."""

Area = tuple[tuple[float, float], tuple[float, float]]
"""Edges of a rectangle in world x and in world y, m."""


def floor_areas(world: World, margin: float) -> list[Area]:
    """Return the rectangles that a world's floor is made of.

    Parameters
    ----------
    world : World
    margin : float
        How far it reaches beyond path and start, m.
    """
    points = np.array([*world.path.points, world.start[:2]])
    left, bottom = points.min(axis=0) - margin
    right, top = points.max(axis=0) + margin
    areas: list[Area] = []
    if world.corridor:
        half = world.corridor.width / 2.0
        bottom, top = -half, half
        for branch in world.corridor.side_corridors:
            edge = half + branch.length
            low, high = (half, edge) if branch.side == "left" else (-edge, -half)
            begin = branch.x - branch.width / 2.0
            areas.append(((begin, begin + branch.width), (low, high)))
    return [*areas, ((float(left), float(right)), (float(bottom), float(top)))]


@lru_cache(maxsize=4)
def _sky(width: int, height: int) -> Image.Image:
    share = np.linspace(0.0, 1.0, height)[:, None, None]
    sky = (SKY_HIGH + share * (SKY_LOW - SKY_HIGH)).astype(np.uint8)
    return Image.fromarray(np.repeat(sky, width, axis=1))


class Floor:
    """The floor of a world, painted.

    Parameters
    ----------
    areas : sequence of Area
        What is tiled.
    """

    def __init__(self, areas: Sequence[Area]) -> None:
        self.areas = areas
        # The whole area light, and the dark tiles on it.
        polygons: list[Array] = []
        self._colours: list[tuple[int, int, int]] = []
        for (west, east), (south, north) in areas:
            whole = np.array([[[west, south], [east, south], [east, north], [west, north]]])
            dark = _tiles(west, east, south, north)[1]
            polygons += [whole, dark]
            self._colours += [PAINT] + [PAINT_DARK] * len(dark)
        self._corners = np.concatenate(polygons)

    def paint(self, camera: Camera) -> Image.Image:
        """Return sky and floor as a camera sees them, RGB."""
        width, height = camera.width, camera.height
        image = _sky(width, height).copy()
        polygon = ImageDraw.Draw(image).polygon
        plane = (camera.projection @ camera.view)[np.ix_((0, 1, 3), (0, 1, 3))]
        clip = self._corners @ plane[:, :2].T + plane[:, 2]
        nearest = clip[..., 2].min(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            pixels = _pixels(clip, width, height)
        # Most of a floor is beside the picture.
        low, high = pixels.min(axis=1), pixels.max(axis=1)
        beside = ((high < 0.0) | (low > (width, height))).any(axis=1)
        behind = nearest <= NEAREST
        for index in np.flatnonzero(behind | ~beside):
            if behind[index]:
                seen = _in_front(clip[index])
                corners = _pixels(seen, width, height) if len(seen) else None
            else:
                corners = pixels[index]
            if corners is not None:
                polygon(corners.ravel().tolist(), fill=self._colours[index])
        return image


def _pixels(clip: Array, width: int, height: int) -> Array:
    """Return pixels, shape (..., 2), of points in clip space (x, y, w)."""
    half = np.array([width / 2.0, -height / 2.0])
    return np.asarray(clip[..., :2] / clip[..., 2:] * half + (width / 2.0, height / 2.0))


def _tiles(west: float, east: float, south: float, north: float) -> tuple[Array, Array]:
    """Return the corners of a rectangle's light and of its dark tiles, each (n, 4, 2), m."""
    columns = np.arange(math.ceil((east - west) / TILE))
    rows = np.arange(math.ceil((north - south) / TILE))
    column, row = (axis.ravel() for axis in np.meshgrid(columns, rows))
    left, bottom = west + column * TILE, south + row * TILE
    right, top = np.minimum(left + TILE, east), np.minimum(bottom + TILE, north)
    corners = np.stack((left, bottom, right, bottom, right, top, left, top), -1).reshape(-1, 4, 2)
    odd = (column + row) % 2 == 1
    return corners[~odd], corners[odd]


def _in_front(corners: Array) -> Array:
    """Return what of a polygon in clip space (x, y, w) lies in front of the camera."""
    kept: list[Array] = []
    for here, there in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if here[2] > NEAREST:
            kept.append(here)
        if (here[2] > NEAREST) != (there[2] > NEAREST):
            share = (NEAREST - here[2]) / (there[2] - here[2])
            kept.append(here + share * (there - here))
    return np.array(kept)


def lay_floor(client: int, across: tuple[float, float], along: tuple[float, float]) -> list[int]:
    """Tile a rectangle at height 0: one mesh a colour renders in half the time of boxes.

    Parameters
    ----------
    client : int
        Where to lay it.
    across, along : (float, float)
        Its edges in world x and in world y, m.

    Returns
    -------
    list of int
        Body ids.
    """
    bodies: list[int] = []
    for tiles, colour in zip(_tiles(*across, *along), (FLOOR, FLOOR_DARK), strict=True):
        if not len(tiles):
            continue
        ground = tiles.reshape(-1, 2)
        first = np.arange(0, len(ground), 4)[:, None]
        shape = engine.createVisualShape(
            engine.GEOM_MESH,
            vertices=np.concatenate((ground, np.zeros((len(ground), 1))), axis=-1).tolist(),
            indices=np.add(first, [0, 1, 2, 0, 2, 3]).ravel().tolist(),
            normals=[(0.0, 0.0, 1.0)] * len(ground),
            rgbaColor=colour,
            physicsClientId=client,
        )
        bodies.append(
            engine.createMultiBody(0.0, baseVisualShapeIndex=shape, physicsClientId=client)
        )
    return bodies
