"""What a robot weighs as one rigid body. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from ..basics.errors import InputError
from ..basics.frames import Frame, Vector, within
from ..basics.motion import Array
from .accepted import number
from .read import end_of, link_frames, origin

COARSE = 1.5
"""By how much one moment of inertia may be more than the other two together, which no body has:
links of published robots are off by up to a sixth, wrong units by far more (inferred)."""
LEAST_MASS = 1.0
"""Of a robot that two can hold, kg (inferred): below it units or decimals are usually wrong."""


SPECK = 0.01
"""Share of a robot's mass, and of its moment of inertia, below which a part may have an inertia
that no body has: it is then taken for a point. Makers of robots make up the numbers of aerials,
cameras and finger tips; whatever is right for them changes the whole by less (inferred)."""


@dataclass(frozen=True)
class Rigid:
    """A robot with its joints locked, as one rigid body, in the axes of its root link.

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


_KEYS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


class _Part(NamedTuple):
    """A link with mass; what is wrong with its inertia, which is then that of a point."""

    mass: float
    centre: Array
    yaw_inertia: float
    largest: float
    fault: str


def lump(root: ElementTree.Element) -> Rigid:
    """Return a robot as one rigid body, as its joints stand.

    Parts without mass add nothing, whether they are solid or not.

    Raises
    ------
    InputError
        If its mass is less than `LEAST_MASS`, its base is solid and has none, an inertia is
        none that a body can have in a part that matters, or its joints do not form one tree.
    """
    frames = link_frames(root)
    _refuse_weightless_base(root)
    parts = [
        _part(link, inertial, frames)
        for link in root.findall("link")
        if (inertial := link.find("inertial")) is not None and _mass(link) > 0.0
    ]
    total = sum(part.mass for part in parts)
    if total <= 0.0:
        raise InputError("its links have no mass")
    if total < LEAST_MASS:
        raise InputError(
            f"its links weigh {total:.3g} kg together: it must be {LEAST_MASS:g} kg or "
            "more (URDF counts in kg)"
        )
    centre = sum((part.mass * part.centre for part in parts), np.zeros(3)) / total
    yaw = sum(
        part.yaw_inertia + part.mass * float(np.sum((part.centre - centre)[:2] ** 2))
        for part in parts
    )
    for part in parts:
        if part.fault and not (part.mass < SPECK * total and part.largest < SPECK * yaw):
            raise InputError(part.fault)
    if not yaw > 0.0:
        raise InputError("nothing resists a turn about the vertical; give links <inertia>")
    places = {name: _vector(place) for name, (_, place) in frames.items()}
    return Rigid(total, _vector(centre), float(yaw), places)


def _mass(link: ElementTree.Element) -> float:
    """Return the mass of a link, kg: 0 where none is given."""
    found = link.find("inertial/mass")
    mass = number(found, "value") if found is not None else 0.0
    if mass < 0.0:
        name = link.get("name", "")
        raise InputError(f"link {name!r} has mass = {mass:g} kg: it must be at least 0")
    return mass


def _refuse_weightless_base(root: ElementTree.Element) -> None:
    """Refuse a robot whose root, and whatever is fixed to it, is solid and has no mass.

    That is a mass forgotten. Elsewhere a maker left out what adds little: a marker, a finger.
    """
    below: dict[str, list[str]] = {}
    for joint in root.findall("joint"):
        if joint.get("type") == "fixed":
            below.setdefault(end_of(joint, "parent"), []).append(end_of(joint, "child"))
    links = {link.get("name", ""): link for link in root.findall("link")}
    children = {end_of(joint, "child") for joint in root.findall("joint")}
    base = [name for name in links if name not in children]
    for name in base:  # which grows meanwhile
        base += below.get(name, [])
    solid = [name for name in base if links[name].find("collision") is not None]
    if solid and not any(_mass(links[name]) for name in base):
        raise InputError(
            f"link {solid[0]!r} has collision shapes but no mass, like all that is fixed to the "
            "root; give it <inertial> with <mass> and <inertia>, or take the shapes out"
        )


def _part(
    link: ElementTree.Element, inertial: ElementTree.Element, frames: dict[str, Frame]
) -> _Part:
    name = link.get("name", "")
    turned, centre = within(frames[name], origin(inertial))
    element = inertial.find("inertia")
    inertia = np.zeros((3, 3)) if element is None else _inertia(element)  # none: of a point
    what = _impossible(element, inertia) if element is not None else ""
    if what:
        fault, largest = f"link {name!r} has {what}", float(np.abs(inertia).max())
        return _Part(_mass(link), centre, 0.0, largest, fault)
    in_root = turned @ inertia @ turned.T
    return _Part(_mass(link), centre, in_root[2, 2], 0.0, "")


def _inertia(element: ElementTree.Element) -> Array:
    """Return a link's inertia in its own axes, kg m^2, shape (3, 3)."""
    xx, yy, zz, xy, xz, yz = (number(element, key) for key in _KEYS)
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _impossible(element: ElementTree.Element, inertia: Array) -> str:
    """Return why no body has an inertia, or nothing; zeros are that of a point."""
    if not inertia.any():
        return ""
    for key in _KEYS[:3]:
        if (value := number(element, key)) <= 0.0:
            return f"{key} = {value:g} kg m^2: must be above 0"
    least, middle, most = (float(moment) for moment in np.linalg.eigvalsh(inertia))
    moments = f"principal moments {least:.3g}, {middle:.3g}, {most:.3g} kg m^2"
    if least <= 0.0:
        return f"{moments}: all three must be above 0"
    if most > COARSE * (least + middle):
        return f"{moments}: no body can have more about one axis than about the other two together"
    return ""


def _vector(array: Array) -> Vector:
    x, y, z = (float(v) for v in array)
    return x, y, z
