"""What a robot occupies, from the shapes in its URDF: one by one, and its floor plan. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from ..basics.errors import InputError
from ..basics.frames import Frame, within
from ..basics.motion import Array
from ..world.outline import SIDES, Disc, Outline, hull
from .accepted import number, numbers
from .meshes import read_mesh
from .read import link_frames, origin

FARTHEST = 5.0
"""From its root to the end of any shape of a robot that walks with people, m (inferred)."""
MOST_BYTES = 200_000_000
"""Of a mesh."""
UPRIGHT = 1.0 - 1e-9
"""Cosine of the tilt up to which a cylinder counts as upright."""


@dataclass(frozen=True, eq=False)
class Solid:
    """A shape of a link, in the axes of the root link: the hull of its points, grown all around.

    Attributes
    ----------
    link : str
    points : ndarray, shape (n, 3)
        m.
    radius : float
        How much it is larger than that hull on the floor plan, m.
    rise : float
        How much it is higher and lower than that, m: nothing for a cylinder.
    faces : ndarray, shape (m, 3), or None
        Of a mesh, which may be hollow: three numbers of points each.
    """

    link: str
    points: Array
    radius: float = 0.0
    rise: float = 0.0
    faces: NDArray[np.int64] | None = None

    @property
    def discs(self) -> list[Disc]:
        """What its floor plan is the hull of."""
        return [(float(x), float(y), self.radius) for x, y, _ in self.points]

    @property
    def top(self) -> float:
        """How high it is above the floor, m."""
        return float(self.points[:, 2].max()) + self.rise


def robot_solids(root: ElementTree.Element) -> tuple[Solid, ...]:
    """Return the collision shapes of a robot, or if it has none the visible ones.

    Joints are where the file puts them; a robot may have neither.

    Parameters
    ----------
    root : Element
        Of a URDF that `cowalk.sim.urdf.accepted.check_urdf` took, mesh files given by absolute
        paths.

    Raises
    ------
    InputError
        If a mesh cannot be read.
    """
    frames = link_frames(root)
    solids: tuple[Solid, ...] = ()
    for kind in ("collision", "visual"):
        solids = tuple(
            _solid(name, element, within(frames[name], origin(element)))
            for name, link in ((link.get("name", ""), link) for link in root.findall("link"))
            for element in link.findall(kind)
        )
        if solids:
            break
    return solids


def robot_outline(solids: tuple[Solid, ...]) -> tuple[Outline, float]:
    """Return the convex outline around the shapes of a robot, and how high they are (m).

    Raises
    ------
    InputError
        If the shapes have no breadth, or one is larger than what walks with people.
    """
    for solid in solids:
        reach = float(np.abs(solid.points).max()) + solid.radius
        if reach > FARTHEST:
            mesh = "; a mesh drawn in mm needs scale='0.001 0.001 0.001'"
            raise InputError(
                f"a shape of link {solid.link!r} reaches {reach:.4g} m from the root: must "
                f"be {FARTHEST:g} m or less{mesh if solid.faces is not None else ''}"
            )
    try:
        outline = hull(disc for solid in solids for disc in solid.discs)
    except ValueError as error:
        raise InputError("its shapes have no breadth") from error
    return outline, max(0.0, *(solid.top for solid in solids))


def _solid(link: str, element: ElementTree.Element, frame: Frame) -> Solid:
    """Return one shape of a link whose place is given."""
    shape = element.find("geometry/*")
    assert shape is not None, "checked"

    def placed(points: Array) -> Array:
        return np.asarray(points @ frame[0].T + frame[1])

    if shape.tag == "sphere":
        radius = number(shape, "radius")
        return Solid(link, placed(np.zeros((1, 3))), radius, radius)
    if shape.tag == "box":
        signs = np.array(np.meshgrid(*[(-0.5, 0.5)] * 3)).reshape(3, -1).T
        return Solid(link, placed(signs * numbers(shape, "size")))
    if shape.tag in ("cylinder", "capsule"):
        half, radius = number(shape, "length") / 2.0, number(shape, "radius")
        ends = np.array([[0.0, 0.0, -half], [0.0, 0.0, half]])
        if shape.tag == "capsule":
            return Solid(link, placed(ends), radius, radius)
        if abs(frame[0][2, 2]) >= UPRIGHT:
            return Solid(link, placed(ends), radius)
        turn = np.arange(SIDES) * (2.0 * np.pi / SIDES)
        rim = radius * np.stack((np.cos(turn), np.sin(turn), 0.0 * turn), axis=-1)
        return Solid(link, placed((ends[:, None] + rim).reshape(-1, 3)))
    try:
        points, faces = read_mesh(shape.get("filename", ""))
    except ValueError as error:
        raise InputError(f"link {link!r}: {error}") from error
    return Solid(link, placed(points * numbers(shape, "scale")), faces=faces)
