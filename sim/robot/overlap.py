"""Whether a human who holds a handle would stand inside the robot, shape by shape. Pure."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..basics.errors import InputError
from ..basics.frames import Vector
from ..basics.motion import Array
from ..body.anthropometry import ANKLE_HEIGHT, HALF_HIPS, TRUNK_DEPTH, BodyParameters
from ..body.human_body import trunk_outline
from ..urdf.solids import Solid
from ..world.outline import Outline, across, hull, hull_corners

TOLERANCE = 0.02
"""How far a robot may reach into a human, m (inferred): shapes are coarse, and flesh gives way."""
SEAT_HEIGHT = 0.48
"""Where the trunk ends and legs begin, share of the height (inferred: that of the figure)."""
MESH_STEP = 0.02
"""How far a human is moved before a mesh that they stand inside of is looked at again, m."""
ASIDE = {"backwards": (-1.0, 0.0), "right": (0.0, -1.0), "left": (0.0, 1.0), "forwards": (1.0, 0.0)}
"""Where to a handle may be moved, base axes."""
COARSE = 4
"""Every how manieth corner of a slice meshes are compared with: it is then 2 mm smaller."""


class Slice(NamedTuple):
    """What a human occupies between two heights, m."""

    outline: Outline
    low: float
    high: float


class Block(NamedTuple):
    """A shape of the robot that comes near a slice of the human, seen from the human's place."""

    solid: Solid
    slice: Slice
    faces: Array
    """Normals and offsets, shape (n, 3): a shift s of the human overlaps if all are below 0
    at -s, for shapes without holes."""
    cut: Array | None
    """Of a mesh: its triangles at the height of the slice, shape (n, 3, 2), m."""
    section: Array | None
    """Of a mesh: see `_section`, in the middle of the slice."""

    def exit(self, way: Array) -> float:
        """Return how far to go along a unit vector to be out of the hull, m."""
        rates = self.faces[:, :2] @ -way
        leaving = rates > 1e-9
        return float(np.min(-self.faces[leaving, 2] / rates[leaving]))

    def holds(self, shift: Array) -> bool:
        """Return whether the human, moved by a shift, stands inside the shape."""
        if (self.faces[:, :2] @ -shift + self.faces[:, 2]).max() >= 0.0:
            return False
        if self.cut is None:
            return True
        polygon = self.slice.outline.polygon[::COARSE] + shift
        if _touches(self.cut, polygon):
            return True
        # Above and below the polygon there is nothing but solid, or nothing: one height tells.
        return self.section is not None and _winds(self.section, polygon.mean(axis=0))


def refuse_overlap(
    body: BodyParameters, place: Vector, solids: tuple[Solid, ...], handle: Vector, name: str
) -> None:
    """Refuse a handle that puts legs or trunk of who holds it inside the robot.

    Arms may reach over it. Below the ankles feet step over what there is.

    Parameters
    ----------
    body : BodyParameters
    place : (x, y, theta)
        Of the trunk, base axes, m, m, rad.
    solids : tuple of Solid
    handle : (x, y, z)
        What is held, base axes, m.
    name : str
        Of its link.

    Raises
    ------
    InputError
        If they overlap by more than `TOLERANCE`: by how much, and where the handle would do.
    """
    inside = _overlapped(body, place, solids)
    if not inside:
        return
    every = (_block(*pair) for pair in _pairs(body, place, solids))
    blocks = [block for block in every if block is not None]
    shortest, nearest = min((_way_out(blocks, np.array(way)), side) for side, way in ASIDE.items())
    move = math.ceil(100.0 * (shortest + TOLERANCE)) / 100.0
    links = ", ".join(dict.fromkeys(repr(block.solid.link) for block in inside))
    hand, other = "both hands" if body.hand == "both" else f"the {body.hand} hand", ""
    beyond = (place[0], 2.0 * handle[1] - place[1], -place[2])
    if body.hand != "both" and not _overlapped(body, beyond, solids):
        other = f", or hold it with the {'left' if body.hand == 'right' else 'right'} hand"
    raise InputError(
        f"robot.handle = {name!r}: who holds it with {hand} stands {move:.2f} m inside the shapes "
        f"of link {links}; move it {move:.2f} m {nearest}, or to the robot's rim{other}",
        ("robot", "handle"),
    )


def _pairs(
    body: BodyParameters, place: Vector, solids: tuple[Solid, ...]
) -> list[tuple[Solid, Slice]]:
    return [(solid, part) for part in _slices(body, place) for solid in solids]


def _overlapped(body: BodyParameters, place: Vector, solids: tuple[Solid, ...]) -> list[Block]:
    near = [_block(*pair) for pair in _pairs(body, place, solids) if _near(*pair)]
    return [block for block in near if block is not None and block.holds(np.zeros(2))]


def _slices(body: BodyParameters, place: Vector) -> tuple[Slice, Slice]:
    """Return legs and trunk, smaller all around by the tolerance, base axes."""
    seat = SEAT_HEIGHT * body.height
    breadth = 2.0 * HALF_HIPS * body.height
    legs, trunk = (
        Outline(tuple((x, y, radius - TOLERANCE) for x, y, radius in whole.moved(place).discs))
        for whole in (across(breadth, TRUNK_DEPTH * breadth), trunk_outline(body))
    )
    return Slice(legs, ANKLE_HEIGHT * body.height, seat), Slice(trunk, seat, body.height)


def _near(solid: Solid, part: Slice) -> bool:
    """Return whether the boxes around two floor plans overlap: quick to say, and mostly no."""
    back, front, right, left = part.outline.box
    low, high = solid.points.min(axis=0) - solid.radius, solid.points.max(axis=0) + solid.radius
    return bool(back < high[0] and front > low[0] and right < high[1] and left > low[1])


def _block(solid: Solid, part: Slice) -> Block | None:
    """Return a shape as an obstacle to a slice of the human; None if it is higher or lower."""
    cut = _cut(solid, part)
    if cut is None:
        low, high = part.low - solid.rise, part.high + solid.rise
        rims = _between(solid.points, low, high)[:, :2]
    else:
        rims = cut.reshape(-1, 2)
    if not len(rims):
        return None
    if solid.radius > 0.0:
        rims = hull((x, y, solid.radius) for x, y in rims.tolist()).polygon
    elif len(rims) > len(part.outline.polygon):
        rims = rims[hull_corners(rims)]
    # Slow to import, and needed only where a human stands near the robot's middle.
    from scipy.spatial import ConvexHull

    apart = (part.outline.polygon[:, None] - rims[None]).reshape(-1, 2)
    section = _section(solid, (part.low + min(part.high, solid.top)) / 2.0)
    return Block(solid, part, ConvexHull(apart).equations, cut, section)


def _between(points: Array, low: float, high: float) -> Array:
    """Return points whose hull is that of given ones between two heights, shape (n, 3)."""
    heights = points[:, 2]
    kept = [points[(heights >= low) & (heights <= high)]]
    for level in (low, high):
        under, over = points[heights < level], points[heights > level]
        if len(under) and len(over):
            share = (level - under[:, None, 2]) / (over[None, :, 2] - under[:, None, 2])
            crossing = under[:, None] + share[..., None] * (over[None] - under[:, None])
            kept.append(crossing.reshape(-1, 3))
    return np.concatenate(kept)


def _way_out(blocks: list[Block], way: Array) -> float:
    """Return how far to go along a unit vector until nothing is overlapped any more, m."""
    gone = 0.0
    while inside := [block for block in blocks if block.holds(gone * way)]:
        hulls = [block.exit(way) for block in inside]
        hollow = all(block.solid.faces is not None for block in inside)
        gone = min(gone + MESH_STEP, max(hulls)) if hollow else max(hulls)
        gone += 1e-9  # rounding must not keep it at the rim
    return gone


def _cut(solid: Solid, part: Slice) -> Array | None:
    """Return the floor plans of a mesh's triangles between two heights, shape (n, 3, 2), m."""
    if solid.faces is None:
        return None
    # Slow to import, and needed for meshes alone.
    from trimesh.intersections import slice_faces_plane

    points, faces = solid.points, solid.faces
    for up, level in ((1.0, part.low), (-1.0, part.high)):
        plane = np.array([0.0, 0.0, up]), np.array([0.0, 0.0, level])
        points, faces = slice_faces_plane(points, faces, *plane)[:2]  # type: ignore[no-untyped-call]
    return np.asarray(points[faces][..., :2])


def _touches(triangles: Array, polygon: Array) -> bool:
    """Return whether any of the triangles (n, 3, 2) overlaps a convex polygon (m, 2).

    Two convex figures are apart if a line along an edge of either separates them.
    """
    # Coordinate by coordinate, and less each time: there may be a million of them.
    for axis in (0, 1):
        a, b, c = (triangles[:, corner, axis] for corner in (0, 1, 2))
        low, high = polygon[:, axis].min(), polygon[:, axis].max()
        some = ((a < high) | (b < high) | (c < high)) & ((a > low) | (b > low) | (c > low))
        triangles = triangles[some]
    edge = np.roll(polygon, -1, axis=0) - polygon
    normals = np.stack((edge[:, 1], -edge[:, 0]))  # outwards: corners go counter-clockwise
    beyond = (triangles @ normals).min(axis=1) >= np.sum(polygon * normals.T, axis=1)
    triangles = triangles[~beyond.any(axis=1)]
    edge = np.roll(triangles, -1, axis=1) - triangles
    normals = np.stack((edge[..., 1], -edge[..., 0]), axis=-2)
    own, other = triangles @ normals, polygon @ normals
    apart = (own.min(axis=1) > other.max(axis=1)) | (own.max(axis=1) < other.min(axis=1))
    return bool((~apart.any(axis=1)).any())


def _section(solid: Solid, height: float) -> Array | None:
    """Return where a mesh is cut at a height, as directed segments, shape (n, 2, 2), m.

    What is solid lies to the left of each.
    """
    if solid.faces is None:
        return None
    corners = solid.points[solid.faces]
    over = corners[..., 2] > height
    corners = corners[over.any(axis=1) & ~over.all(axis=1)]
    start, end = corners, np.roll(corners, -1, axis=1)
    above, below = start[..., 2] > height, end[..., 2] > height
    # Every triangle has one side that comes down through the height, and one that goes up.
    ends = [
        (a + ((height - a[:, 2]) / (b[:, 2] - a[:, 2]))[:, None] * (b - a))[:, :2]
        for crosses in (above & ~below, ~above & below)
        for a, b in ((start[crosses], end[crosses]),)
    ]
    return np.stack(ends, axis=1)


def _winds(segments: Array, point: Array) -> bool:
    """Return whether directed segments wind around a point: by the angles they are seen under."""
    a, b = np.moveaxis(segments - point, 1, 0)
    turned = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], np.sum(a * b, axis=1))
    return bool(abs(turned.sum()) > math.pi)
