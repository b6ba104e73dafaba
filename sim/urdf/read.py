"""Reading URDF: where links are, and what they weigh as one rigid body. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ..basics.errors import InputError
from ..basics.frames import Frame, Vector, rotation, within
from ..basics.motion import Array
from .accepted import check_urdf, number, numbers

COARSE = 1.5
"""By how much one moment of inertia may be more than the other two together, which no body has:
links of published robots are off by up to a sixth, wrong units by far more (inferred)."""
LEAST_MASS = 1.0
"""Of a robot that two can hold, kg (inferred): below it units or decimals are usually wrong."""


@dataclass(frozen=True)
class Rigid:
    """A robot with all its joints at zero, as one rigid body, in the axes of its root link.

    Attributes
    ----------
    mass : float
        kg.
    centre : (x, y, z)
        Centre of mass, m.
    yaw_inertia : float
        About the vertical through the centre of mass, kg m^2.
    places : dict of str to (x, y, z)
        Origin of every link, m.
    """

    mass: float
    centre: Vector
    yaw_inertia: float
    places: dict[str, Vector]


def read_robot(path: Path) -> ElementTree.Element:
    """Return the root element of a URDF file.

    Raises
    ------
    InputError
        If there is no such file, or it is no URDF, or `check_urdf` refuses it.
    """
    try:
        root = ElementTree.parse(path).getroot()
    except OSError as error:
        raise _faulty(path, "no such file can be read") from error
    except (ElementTree.ParseError, LookupError) as error:  # the latter: an unknown encoding
        raise _faulty(path, f"no XML: {error}") from error
    if root.tag != "robot" or root.find("link") is None:
        raise _faulty(path, "no <robot> with a <link> in it")
    check_urdf(root)
    return root


def _faulty(path: Path, what: str) -> InputError:
    return InputError(f"urdf = {str(path)!r}: {what}", ("urdf",))


def origin(element: ElementTree.Element) -> Frame:
    """Return rotation (3, 3) and translation (3,) of an element's <origin>."""
    found = element.find("origin")
    if found is None:
        return np.eye(3), np.zeros(3)
    return rotation(*numbers(found, "rpy")), numbers(found, "xyz")


def _inertia(link: str, element: ElementTree.Element) -> Array:
    """Return a link's inertia in its own axes, kg m^2, shape (3, 3); zeros are those of a point."""
    keys = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    values = [number(element, key) for key in keys]
    xx, yy, zz, xy, xz, yz = values
    matrix = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if not any(values):
        return matrix
    for key, value in zip(keys, values, strict=True):
        if value <= 0.0 and key in keys[:3]:
            raise InputError(f"link {link!r} has {key} = {value:g} kg m^2: must be above 0")
    least, middle, most = (float(moment) for moment in np.linalg.eigvalsh(matrix))
    moments = f"principal moments {least:.3g}, {middle:.3g}, {most:.3g} kg m^2"
    if least <= 0.0:
        raise InputError(f"link {link!r} has {moments}: all three must be above 0")
    if most > COARSE * (least + middle):
        raise InputError(
            f"link {link!r} has {moments}: no body can have more about one axis than "
            "about the other two together"
        )
    return matrix


def link_frames(root: ElementTree.Element) -> dict[str, Frame]:
    """Return rotation (3, 3) and origin (3,) of every link's frame, all joints at zero.

    Raises
    ------
    InputError
        If the joints do not form one tree.
    """
    children = {_end(joint, "child"): joint for joint in root.findall("joint")}
    frames: dict[str, Frame] = {}

    def frame(name: str) -> Frame:
        above = [name]  # up to what is known; a file may be thousands of links deep
        while above[-1] not in frames and above[-1] in children:
            if len(above) > len(children):
                raise InputError(f"the joints above link {name!r} form a loop")
            above.append(_end(children[above[-1]], "parent"))
        frames.setdefault(above[-1], (np.eye(3), np.zeros(3)))
        for upper, lower in pairwise(reversed(above)):
            frames[lower] = within(frames[upper], origin(children[lower]))
        return frames[name]

    names = [link.get("name", "") for link in root.findall("link")]
    if len(roots := [name for name in names if name not in children]) != 1:
        which = f" ({', '.join(roots)})" if roots else ""
        raise InputError(f"{len(roots)} links are no joint's child{which}: must be one, the root")
    return {name: frame(name) for name in names}


def lump(root: ElementTree.Element) -> Rigid:
    """Return a robot as one rigid body, all joints at zero.

    Raises
    ------
    InputError
        If its mass is less than `LEAST_MASS`, a solid link has none, an inertia is none that a
        body can have, or its joints do not form one tree.
    """
    frames = link_frames(root)
    parts = []
    for link in root.findall("link"):
        name, inertial = link.get("name", ""), link.find("inertial")
        found = inertial.find("mass") if inertial is not None else None
        mass = number(found, "value") if found is not None else 0.0
        if mass < 0.0:
            raise InputError(f"link {name!r} has mass = {mass:g} kg: it must be at least 0")
        if inertial is None or mass == 0.0:
            if link.find("collision") is not None:
                raise InputError(
                    f"link {name!r} has collision shapes but no mass; give it <inertial> "
                    "with <mass> and <inertia>, or take the shapes out"
                )
            continue
        turned, centre = within(frames[name], origin(inertial))
        element = inertial.find("inertia")
        inertia = np.zeros((3, 3))  # of a point
        if element is not None:
            inertia = turned @ _inertia(name, element) @ turned.T
        parts.append((mass, centre, inertia[2, 2]))
    total = sum(mass for mass, _, _ in parts)
    if total <= 0.0:
        raise InputError("its links have no mass")
    if total < LEAST_MASS:
        raise InputError(
            f"its links weigh {total:.3g} kg together: it must be {LEAST_MASS:g} kg or "
            "more (URDF counts in kg)"
        )
    centre = sum((mass * place for mass, place, _ in parts), np.zeros(3)) / total
    yaw = sum(izz + m * float(np.sum((p - centre)[:2] ** 2)) for m, p, izz in parts)
    if not yaw > 0.0:
        raise InputError("nothing resists a turn about the vertical; give links <inertia>")
    places = {name: _vector(place) for name, (_, place) in frames.items()}
    return Rigid(total, _vector(centre), float(yaw), places)


def _end(joint: ElementTree.Element, end: str) -> str:
    """Return the name of a joint's parent or child link."""
    found = joint.find(end)
    return found.get("link", "") if found is not None else ""


def _vector(array: Array) -> Vector:
    x, y, z = (float(v) for v in array)
    return x, y, z


def left_right_swapped(root: ElementTree.Element) -> ElementTree.Element:
    """Return a robot with left and right swapped (y to -y), for bodies of plain shapes."""
    copy = ElementTree.fromstring(ElementTree.tostring(root))
    for place in copy.iter("origin"):
        x, y, z = numbers(place, "xyz")
        roll, pitch, yaw = numbers(place, "rpy")
        place.set("xyz", f"{x} {-y} {z}")
        place.set("rpy", f"{-roll} {pitch} {-yaw}")
    return copy
