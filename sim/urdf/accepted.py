"""A URDF judged before anything is read from it: its numbers, its shapes, its tree. Pure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from ..basics.errors import InputError
from ..basics.motion import Array
from ..basics.registry import did_you_mean
from .unexpanded import substitution

Element = ElementTree.Element


class Numbers(NamedTuple):
    """What an attribute must hold."""

    needed: int
    meaning: str
    default: str | None = None
    """What it is where it is left out; None if it must not be."""
    least: float = -np.inf


XYZ, LENGTH = "x y z in m", "m"
NUMBERS: dict[str, dict[str, Numbers]] = {
    "origin": {
        "xyz": Numbers(3, XYZ, "0 0 0"),
        "rpy": Numbers(3, "roll pitch yaw in rad", "0 0 0"),
    },
    "mass": {"value": Numbers(1, "kg")},
    "inertia": {
        key: Numbers(1, "kg m^2", "0") for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    },
    "box": {"size": Numbers(3, XYZ, None, 0.0)},
    "sphere": {"radius": Numbers(1, LENGTH, None, 0.0)},
    "cylinder": {
        "radius": Numbers(1, LENGTH, None, 0.0),
        "length": Numbers(1, LENGTH, None, 0.0),
    },
    "capsule": {
        "radius": Numbers(1, LENGTH, None, 0.0),
        "length": Numbers(1, LENGTH, None, 0.0),
    },
    "mesh": {"scale": Numbers(3, "x y z", "1 1 1")},
    "axis": {"xyz": Numbers(3, "x y z", "1 0 0")},
    "limit": {key: Numbers(1, "rad or m", "0") for key in ("lower", "upper")},
    "mimic": {"multiplier": Numbers(1, "", "1"), "offset": Numbers(1, "rad or m", "0")},
    "color": {"rgba": Numbers(4, "red green blue alpha from 0 to 1", None, 0.0)},
}
"""By tag and attribute, everything that is read as numbers, by us or by who draws it."""
SHAPES = ("box", "sphere", "cylinder", "capsule", "mesh")


def numbers(element: Element, attribute: str) -> Array:
    """Return the numbers of an attribute that `NUMBERS` knows, its default where there is none.

    Raises
    ------
    InputError
        If they are not as many as needed, not finite, or less than they may be.
    """
    rule = NUMBERS[element.tag][attribute]
    text = element.get(attribute, rule.default)
    parts = (text or "").split()
    try:
        # Python reads 1_0 as ten, others as one.
        values = np.array([float(part.replace("_", "?")) for part in parts])
    except ValueError:
        values = np.array([np.nan])
    right = len(values) == rule.needed and np.isfinite(values).all()
    if right and (values >= rule.least).all():
        return values
    some = "a finite number" if rule.needed == 1 else f"{rule.needed} finite numbers"
    least = f" of at least {rule.least:g}" if np.isfinite(rule.least) else ""
    given = f'<{element.tag}> without "{attribute}"'
    if text is not None:
        given = f'<{element.tag} {attribute}="{" ".join(parts)}">'
    if left := substitution(text):
        raise InputError(f"{given}: {left}")
    meaning = f", {rule.meaning}" if rule.meaning else ""
    raise InputError(f"{given}: must be {some}{least}{meaning}")


def number(element: Element, attribute: str) -> float:
    """Return the one number of an attribute; see `numbers`."""
    return float(numbers(element, attribute)[0])


def check_urdf(root: Element) -> None:
    """Refuse a robot that cannot be read.

    Raises
    ------
    InputError
        With link or joint, tag and attribute, what is given and what would be right.
    """
    for owner, elements in _parts(root):
        for element in elements:
            try:
                if element.tag in ("collision", "visual"):
                    _shape(element)
                for attribute in NUMBERS.get(element.tag, ()):
                    numbers(element, attribute)
            except InputError as error:
                raise InputError(f"{owner}: {error}") from None
    _tree(root)


def _parts(root: Element) -> Iterator[tuple[str, list[Element]]]:
    """Yield who owns them and the elements that are read; files hold much for other programs."""
    for link in root.findall("link"):
        for kind in ("inertial", "collision", "visual"):
            for part in link.findall(kind):
                yield f"link {link.get('name', '')!r}, <{kind}>", list(part.iter())
    for joint in root.findall("joint"):
        yield f"joint {joint.get('name', '')!r}", joint.findall("origin")
    for material in root.findall("material"):
        yield f"material {material.get('name', '')!r}", material.findall("color")


def _shape(element: Element) -> None:
    found = element.find("geometry")
    shape = next(iter(found), None) if found is not None else None
    right = f"must have a <geometry> with one of {', '.join(SHAPES)}"
    if shape is None:
        raise InputError(f"no shape: {right}")
    if shape.tag not in SHAPES:
        raise InputError(f"unknown shape <{shape.tag}>: {right}")
    if shape.tag == "mesh" and not shape.get("filename"):
        raise InputError('<mesh> without "filename": must name a mesh file')
    if left := substitution(shape.get("filename")):
        raise InputError(f'<mesh filename="{shape.get("filename")}">: {left}')


def _tree(root: Element) -> None:
    """Refuse names that are missing, double or unknown, and links with two joints above them."""
    for part in (*root.findall("link"), *root.findall("joint")):
        if left := substitution(name := part.get("name")):
            raise InputError(f'<{part.tag} name="{name}">: {left}')
    known: list[str] = []
    for link in root.findall("link"):
        name = link.get("name", "")
        if not name:
            raise InputError('a <link> without "name": give it one')
        if name in known:
            raise InputError(f"there are two links {name!r}: rename one")
        known.append(name)
    above: dict[str, str] = {}
    for joint in root.findall("joint"):
        name = joint.get("name", "")
        for end in ("parent", "child"):
            found = joint.find(end)
            link_name = found.get("link", "") if found is not None else ""
            if not link_name:
                raise InputError(f'joint {name!r}: no <{end} link="...">; name a link')
            if left := substitution(link_name):
                raise InputError(f'joint {name!r}: <{end} link="{link_name}">: {left}')
            if link_name not in known:
                hint = did_you_mean(link_name, known)
                raise InputError(f"joint {name!r}: no {end} link {link_name!r}; {hint}")
        if link_name in above:
            raise InputError(
                f"link {link_name!r} is the child of two joints, {above[link_name]!r} and "
                f"{name!r}: it can have one"
            )
        above[link_name] = name
