"""Reading and writing URDF as XML: what rigid bodies weigh as a whole, and plain chains. Pure."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from .errors import InputError
from .motion import Array

Vector = tuple[float, float, float]
Frame = tuple[Array, Array]
"""Rotation (3, 3) and origin (3,), m."""


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
        If there is no such file, or it is no URDF.
    """
    try:
        root = ElementTree.parse(path).getroot()
    except OSError as error:
        raise InputError(f"robot.urdf = {str(path)!r}: no such file can be read") from error
    except ElementTree.ParseError as error:
        raise InputError(f"robot.urdf = {str(path)!r}: no XML: {error}") from error
    if root.tag != "robot" or root.find("link") is None:
        raise InputError(f"robot.urdf = {str(path)!r}: no <robot> with a <link> in it")
    return root


def numbers(text: str | None) -> Array:
    """Return the numbers of an attribute such as "0 0 1"; three zeros where there is none."""
    return np.array([float(part) for part in (text or "0 0 0").split()])


def origin(element: ElementTree.Element) -> Frame:
    """Return rotation (3, 3) and translation (3,) of an element's <origin>."""
    found = element.find("origin")
    if found is None:
        return np.eye(3), np.zeros(3)
    return rotation(*numbers(found.get("rpy"))), numbers(found.get("xyz"))


def within(outer: Frame, inner: Frame) -> Frame:
    """Return a frame that is given in the axes of an outer one, in what that is given in."""
    (turn, shift), (own_turn, own_shift) = outer, inner
    return turn @ own_turn, shift + turn @ own_shift


def rotation(roll: float, pitch: float, yaw: float) -> Array:
    """Return the rotation matrix of fixed-axis roll, pitch, yaw (rad), shape (3, 3)."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def _float(link: str, what: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise InputError(f"robot: link {link!r} has {what} = {text!r}: not a number") from None


def _inertia(link: str, element: ElementTree.Element) -> Array:
    """Return a link's inertia in its own axes, kg m^2, shape (3, 3); zeros are those of a point."""
    keys = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    values = [_float(link, key, element.get(key, "0")) for key in keys]
    xx, yy, zz, xy, xz, yz = values
    matrix = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if not any(values):
        return matrix
    for key, value in zip(keys, values, strict=True):
        if not math.isfinite(value) or (value <= 0.0 and key in keys[:3]):
            more = "finite" if not math.isfinite(value) else "above 0"
            raise InputError(f"robot: link {link!r} has {key} = {value:g} kg m^2: must be {more}")
    least, middle, most = (float(moment) for moment in np.linalg.eigvalsh(matrix))
    moments = f"principal moments {least:.3g}, {middle:.3g}, {most:.3g} kg m^2"
    if least <= 0.0:
        raise InputError(f"robot: link {link!r} has {moments}: all three must be above 0")
    # Thin plates meet it with equality, which files give in few digits.
    if most > 1.01 * (least + middle):
        raise InputError(
            f"robot: link {link!r} has {moments}: no body can have more about one axis than "
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
    children = {j.find("child").get("link"): j for j in root.iter("joint") if _joint(j)}  # type: ignore[union-attr]
    frames: dict[str, Frame] = {}

    def frame(name: str, depth: int = 0) -> Frame:
        if name not in frames:
            joint = children.get(name)
            if joint is None:
                frames[name] = np.eye(3), np.zeros(3)
            else:
                if depth > len(children):
                    raise InputError(f"robot: the joints above link {name!r} form a loop")
                above = frame(joint.find("parent").get("link"), depth + 1)  # type: ignore[union-attr,arg-type]
                frames[name] = within(above, origin(joint))
        return frames[name]

    names = [link.get("name", "") for link in root.iter("link")]
    if len(roots := [name for name in names if name not in children]) != 1:
        raise InputError(f"robot: {len(roots)} links are no joint's child ({', '.join(roots)})")
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
    for link in root.iter("link"):
        name, inertial = link.get("name", ""), link.find("inertial")
        found = inertial.find("mass") if inertial is not None else None
        mass = _float(name, "mass", found.get("value", "0")) if found is not None else 0.0
        if not 0.0 <= mass < math.inf:
            raise InputError(f"robot: link {name!r} has mass = {mass:g} kg: it must be at least 0")
        if inertial is None or mass == 0.0:
            if link.find("collision") is not None:
                raise InputError(
                    f"robot: link {name!r} has collision shapes but no mass; give it <inertial> "
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
        raise InputError("robot: its links have no mass")
    if total < LEAST_MASS:
        raise InputError(
            f"robot: its links weigh {total:.3g} kg together: it must be {LEAST_MASS:g} kg or "
            "more (URDF counts in kg)"
        )
    centre = sum((mass * place for mass, place, _ in parts), np.zeros(3)) / total
    yaw = sum(izz + m * float(np.sum((p - centre)[:2] ** 2)) for m, p, izz in parts)
    if not yaw > 0.0:
        raise InputError("robot: nothing resists a turn about the vertical; give links <inertia>")
    places = {name: _vector(place) for name, (_, place) in frames.items()}
    return Rigid(total, _vector(centre), float(yaw), places)


def _joint(joint: ElementTree.Element) -> bool:
    return joint.find("child") is not None and joint.find("parent") is not None


def _vector(array: Array) -> Vector:
    x, y, z = (float(v) for v in array)
    return x, y, z


def mirrored(root: ElementTree.Element) -> ElementTree.Element:
    """Return a robot with left and right swapped (y to -y), for bodies of plain shapes."""
    copy = ElementTree.fromstring(ElementTree.tostring(root))
    for place in copy.iter("origin"):
        x, y, z = numbers(place.get("xyz"))
        roll, pitch, yaw = numbers(place.get("rpy"))
        place.set("xyz", f"{x} {-y} {z}")
        place.set("rpy", f"{-roll} {pitch} {-yaw}")
    return copy


LOCKED = '<link name="{0}"><inertial><mass value="0"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>'  # noqa: E501


def link(name: str, mass: float, centre: Vector, yaw_inertia: float) -> str:
    """Return a link that only turns about the vertical, so that one moment of inertia is enough."""
    x, y, z = centre
    return (
        f'<link name="{name}"><inertial><origin xyz="{x!r} {y!r} {z!r}"/><mass value="{mass!r}"/>'
        f'<inertia ixx="{yaw_inertia!r}" iyy="{yaw_inertia!r}" izz="{yaw_inertia!r}" '
        'ixy="0" ixz="0" iyz="0"/></inertial></link>'
    )


def hinge(
    name: str,
    parent: str,
    child: str,
    place: Vector = (0.0, 0.0, 0.0),
    limits: tuple[float, float] | None = None,
) -> str:
    """Return a joint about the vertical, with or without limits (rad)."""
    x, y, z = place
    kind, limit = "continuous", ""
    if limits is not None:
        kind = "revolute"
        limit = f'<limit lower="{limits[0]!r}" upper="{limits[1]!r}" effort="1e9" velocity="1e9"/>'
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{x!r} {y!r} {z!r}"/><axis xyz="0 0 1"/>{limit}</joint>'
    )


FREE = (1.0, -1.0)
"""Limits that the engine takes for none."""


def slider(
    name: str,
    parent: str,
    child: str,
    axis: str,
    place: Vector = (0.0, 0.0, 0.0),
    limits: tuple[float, float] = FREE,
) -> str:
    """Return a joint that slides along an axis, freely or within limits (m)."""
    x, y, z = place
    return (
        f'<joint name="{name}" type="prismatic"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{x!r} {y!r} {z!r}"/><axis xyz="{axis}"/>'
        f'<limit lower="{limits[0]!r}" upper="{limits[1]!r}" effort="1e9" velocity="1e9"/></joint>'
    )


def planar(name: str, root_link: str, parts: str, rises: bool = False) -> str:
    """Return a robot whose ``root_link``, among ``parts``, slides and turns on the floor.

    The engine's planar joint cannot be driven from Python; a chain x, y, yaw can.

    Parameters
    ----------
    name, root_link, parts : str
    rises : bool
        Whether its height is free as well (joint ``z``).
    """
    lift = LOCKED.format("slide_z") + slider("z", "ground", "slide_z", "0 0 1") if rises else ""
    return "".join(
        (
            f'<robot name="{name}">',
            *(LOCKED.format(part) for part in ("ground", "slide_x", "slide_y")),
            lift,
            slider("x", "slide_z" if rises else "ground", "slide_x", "1 0 0"),
            slider("y", "slide_x", "slide_y", "0 1 0"),
            hinge("yaw", "slide_y", root_link),
            parts,
            "</robot>",
        )
    )
