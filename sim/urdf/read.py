"""Reading URDF: the file, and where its links are. Pure."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ..basics.errors import InputError
from ..basics.file_names import read_file
from ..basics.frames import Frame, rotation, within
from .accepted import check_urdf, numbers
from .unexpanded import macro, undeclared

MOST_BYTES = 20_000_000
"""Of a URDF without its meshes; published ones have less than a hundredth (inferred)."""
DEEPEST = 64
"""Elements within elements (inferred): URDF has five."""


def read_robot(path: Path) -> ElementTree.Element:
    """Return the root element of a URDF file.

    Raises
    ------
    InputError
        If there is no such file, or it is no URDF or one with macros left in, or `check_urdf`
        refuses it.
    """
    try:
        data = read_file(path, MOST_BYTES)
    except InputError as error:
        raise _faulty(path, str(error).removeprefix(f"{path}: ")) from error
    if b"<!ENTITY" in data:
        raise _faulty(path, "it declares entities, which no robot needs and some bombs are made of")
    try:
        root = ElementTree.fromstring(data)
    except (ElementTree.ParseError, LookupError, ValueError) as error:  # an unknown encoding
        raise _faulty(path, undeclared(data) or f"no XML: {error}") from error
    if _depth(root) > DEEPEST:
        raise _faulty(path, f"its elements are nested more than {DEEPEST} deep")
    if left := macro(root):
        raise _faulty(path, left)
    if root.tag != "robot" or root.find("link") is None:
        raise _faulty(path, "no <robot> with a <link> in it")
    check_urdf(root)
    return root


def _depth(root: ElementTree.Element) -> int:
    """Return how deep elements are nested, as far as `DEEPEST` tells."""
    depth, level = 0, [root]
    while level and depth <= DEEPEST:
        depth, level = depth + 1, [below for element in level for below in element]
    return depth


def _faulty(path: Path, what: str) -> InputError:
    return InputError(f"urdf = {str(path)!r}: {what}", ("urdf",))


def origin(element: ElementTree.Element) -> Frame:
    """Return rotation (3, 3) and translation (3,) of an element's <origin>."""
    found = element.find("origin")
    if found is None:
        return np.eye(3), np.zeros(3)
    return rotation(*numbers(found, "rpy")), numbers(found, "xyz")


def link_frames(root: ElementTree.Element) -> dict[str, Frame]:
    """Return rotation (3, 3) and origin (3,) of every link's frame, as the joints' origins say.

    Raises
    ------
    InputError
        If the joints do not form one tree.
    """
    children = {end_of(joint, "child"): joint for joint in root.findall("joint")}
    frames: dict[str, Frame] = {}

    def frame(name: str) -> Frame:
        above = [name]  # up to what is known; a file may be thousands of links deep
        while above[-1] not in frames and above[-1] in children:
            if len(above) > len(children):
                raise InputError(f"the joints above link {name!r} form a loop")
            above.append(end_of(children[above[-1]], "parent"))
        frames.setdefault(above[-1], (np.eye(3), np.zeros(3)))
        for upper, lower in pairwise(reversed(above)):
            frames[lower] = within(frames[upper], origin(children[lower]))
        return frames[name]

    names = [link.get("name", "") for link in root.findall("link")]
    if len(roots := [name for name in names if name not in children]) != 1:
        which = f" ({', '.join(roots)})" if roots else ""
        raise InputError(f"{len(roots)} links are no joint's child{which}: must be one, the root")
    return {name: frame(name) for name in names}


def end_of(joint: ElementTree.Element, end: str) -> str:
    """Return the name of a joint's parent or child link."""
    found = joint.find(end)
    return found.get("link", "") if found is not None else ""


def left_right_swapped(root: ElementTree.Element) -> ElementTree.Element:
    """Return a robot with left and right swapped (y to -y), for bodies of plain shapes."""
    copy = ElementTree.fromstring(ElementTree.tostring(root))
    for place in copy.iter("origin"):
        x, y, z = numbers(place, "xyz")
        roll, pitch, yaw = numbers(place, "rpy")
        place.set("xyz", f"{x} {-y} {z}")
        place.set("rpy", f"{-roll} {pitch} {-yaw}")
    return copy
