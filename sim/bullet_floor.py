"""A tiled floor in a PyBullet world that is looked at."""

from __future__ import annotations

import math

import numpy as np

from .bullet_engine import engine

TILE = 1.0
"""Side of the floor's tiles, m: without them one cannot see that the pair moves."""
FLOOR, FLOOR_DARK = (0.80, 0.78, 0.74, 1.0), (0.74, 0.72, 0.68, 1.0)


def lay_floor(client: int, across: tuple[float, float], along: tuple[float, float]) -> None:
    """Tile a rectangle at height 0: one mesh a colour renders in half the time of boxes.

    Parameters
    ----------
    client : int
        Where to lay it.
    across, along : (float, float)
        Its edges in world x and in world y, m.
    """
    (left, right), (bottom, top) = across, along
    columns = np.arange(math.ceil((right - left) / TILE))
    rows = np.arange(math.ceil((top - bottom) / TILE))
    column, row = (axis.ravel() for axis in np.meshgrid(columns, rows))
    west, south = left + column * TILE, bottom + row * TILE
    east, north = np.minimum(west + TILE, right), np.minimum(south + TILE, top)
    corners = np.stack((west, south, east, south, east, north, west, north), axis=-1)
    for odd, colour in ((0, FLOOR), (1, FLOOR_DARK)):
        ground = corners[(column + row) % 2 == odd].reshape(-1, 2)
        if not len(ground):
            continue
        first = np.arange(0, len(ground), 4)[:, None]
        shape = engine.createVisualShape(
            engine.GEOM_MESH,
            vertices=np.concatenate((ground, np.zeros((len(ground), 1))), axis=-1).tolist(),
            indices=np.add(first, [0, 1, 2, 0, 2, 3]).ravel().tolist(),
            normals=[(0.0, 0.0, 1.0)] * len(ground),
            rgbaColor=colour,
            physicsClientId=client,
        )
        engine.createMultiBody(0.0, baseVisualShapeIndex=shape, physicsClientId=client)
