"""What a robot occupies on the floor plan, from the shapes in its URDF. Pure."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from .errors import InputError
from .motion import Array
from .outline import SIDES, Disc, Outline, hull
from .urdf import Frame, link_frames, numbers, origin, within

UPRIGHT = 1.0 - 1e-9
"""Cosine of the tilt up to which a cylinder counts as upright."""


def robot_outline(root: ElementTree.Element) -> tuple[Outline, float] | None:
    """Return the convex outline of a robot, all joints at zero, and how high it is (m).

    Its collision shapes count, or if it has none the visible ones; None if it has neither.

    Parameters
    ----------
    root : Element
        Of a URDF whose mesh files are given by absolute paths.

    Raises
    ------
    InputError
        If a shape has no size, or a mesh cannot be read.
    """
    frames = link_frames(root)
    for kind in ("collision", "visual"):
        discs: list[Disc] = []
        top = 0.0
        for link in root.iter("link"):
            for element in link.findall(kind):
                frame = within(frames[link.get("name", "")], origin(element))
                found, height = _shape(link.get("name", ""), element.find("geometry"), frame)
                discs += found
                top = max(top, height)
        if discs:
            try:
                return hull(discs), top
            except ValueError as error:
                raise InputError(f"robot.urdf: its {kind} shapes have no breadth") from error
    return None


def _shape(
    link: str, geometry: ElementTree.Element | None, frame: Frame
) -> tuple[list[Disc], float]:
    """Return the discs and corners that a shape's floor plan is the hull of, and its top, m."""
    element = next(iter(geometry), None) if geometry is not None else None
    try:
        if element is None:
            raise ValueError("no shape")
        if element.tag == "sphere":
            return _balls(np.zeros((1, 3)), float(element.attrib["radius"]), frame)
        if element.tag == "box":
            signs = np.array(np.meshgrid(*[(-0.5, 0.5)] * 3)).reshape(3, -1).T
            return _points(signs * numbers(element.attrib["size"]), frame)
        if element.tag in ("cylinder", "capsule"):
            half, radius = float(element.attrib["length"]) / 2.0, float(element.attrib["radius"])
            ends = np.array([[0.0, 0.0, -half], [0.0, 0.0, half]])
            if element.tag == "capsule":
                return _balls(ends, radius, frame)
            if abs(frame[0][2, 2]) >= UPRIGHT:
                discs, top = _balls(ends, radius, frame)
                return discs, top - radius
            turn = np.arange(SIDES) * (2.0 * np.pi / SIDES)
            rim = radius * np.stack((np.cos(turn), np.sin(turn), 0.0 * turn), axis=-1)
            return _points((ends[:, None] + rim).reshape(-1, 3), frame)
        if element.tag == "mesh":
            scale = numbers(element.get("scale", "1 1 1"))
            return _points(_vertices(element.attrib["filename"]) * scale, frame)
        raise ValueError(f"unknown shape {element.tag!r}")
    except (KeyError, ValueError) as error:
        reason = f"no {error}" if isinstance(error, KeyError) else error
        raise InputError(f"robot.urdf: a shape of link {link!r}: {reason}") from error


def _balls(centres: Array, radius: float, frame: Frame) -> tuple[list[Disc], float]:
    places = centres @ frame[0].T + frame[1]
    discs = [(float(x), float(y), radius) for x, y, _ in places]
    return discs, float(places[:, 2].max()) + radius


def _points(corners: Array, frame: Frame) -> tuple[list[Disc], float]:
    places = corners @ frame[0].T + frame[1]
    return [(float(x), float(y), 0.0) for x, y, _ in places], float(places[:, 2].max())


def _vertices(name: str) -> Array:
    """Return the vertices of a mesh file, shape (n, 3).

    Raises
    ------
    ValueError
        If it cannot be read.
    """
    # Slow to import, and needed for meshes alone.
    import trimesh

    if not Path(name).is_file():
        raise ValueError(f"there is no mesh {name!r}")
    try:
        return np.asarray(trimesh.load_mesh(name).vertices, dtype=float)
    except ImportError as error:
        raise ValueError(f"mesh {name!r}: {error}; or give it as STL or OBJ") from error
    except Exception as error:  # readers of a dozen formats raise what they like
        raise ValueError(
            f"mesh {name!r} cannot be read: {type(error).__name__}: {error}"
        ) from error
