"""Joints of a URDF put where a user wants them. Pure."""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree import ElementTree

import numpy as np

from ..basics.errors import InputError
from ..basics.frames import Frame, about, roll_pitch_yaw, within
from ..basics.registry import did_you_mean
from .accepted import number, numbers
from .read import origin

TURNS, SLIDES = ("revolute", "continuous"), ("prismatic",)
"""Types of joints with one position: an angle (rad), or a distance (m)."""
ROUNDING = 1e-6
"""By how much a position may be beyond a limit, which files often round, rad or m."""


def put_joints(root: ElementTree.Element, positions: Mapping[str, float]) -> None:
    """Move joints of a robot from zero, in place: their origins are rewritten.

    Joints that mimic one of them follow it.

    Parameters
    ----------
    root : Element
        Of a URDF that `cowalk.sim.urdf.accepted.check_urdf` took.
    positions : mapping of str to float
        By name of joint: rad, or m for one that slides.

    Raises
    ------
    InputError
        If there is no such joint, it does not move or follows another one, or its position is
        beyond its limits.
    """
    movable = {joint.get("name", ""): joint for joint in root.findall("joint") if _moves(joint)}
    for name, position in positions.items():
        try:
            _put(_named(root, movable, name), position)
            for follower in movable.values():
                followed = follower.find("mimic")
                if followed is not None and followed.get("joint") == name:
                    share, offset = number(followed, "multiplier"), number(followed, "offset")
                    _move(follower, share * position + offset)
        except InputError as error:
            raise InputError(f"joints.{name}: {error}", ("joints", name)) from error


def _moves(joint: ElementTree.Element) -> bool:
    return joint.get("type") in (*TURNS, *SLIDES)


def _named(
    root: ElementTree.Element, movable: dict[str, ElementTree.Element], name: str
) -> ElementTree.Element:
    if name in movable:
        return movable[name]
    there = {joint.get("name"): joint.get("type") for joint in root.findall("joint")}
    kinds = ", ".join((*TURNS, *SLIDES))
    if name in there:
        raise InputError(f"this joint is {there[name]!r}: it must be one of {kinds}")
    hint = did_you_mean(name, sorted(movable)) if movable else "this robot has none that moves"
    raise InputError(f"no such joint; {hint}")


def _put(joint: ElementTree.Element, position: float) -> None:
    """Move a joint if nothing forbids it."""
    followed, limit = joint.find("mimic"), joint.find("limit")
    if followed is not None:
        raise InputError(f"it follows joint {followed.get('joint')!r}; set that one")
    if limit is not None and joint.get("type") != "continuous":
        low, high = number(limit, "lower"), number(limit, "upper")
        if not low - ROUNDING <= position <= high + ROUNDING:
            unit = "m" if joint.get("type") in SLIDES else "rad"
            raise InputError(
                f"{position:g} {unit} is beyond its limits, {low:g} to {high:g} {unit}"
            )
    _move(joint, position)


def _move(joint: ElementTree.Element, position: float) -> None:
    """Rewrite a joint's origin as it is at a position: rad or m along its axis."""
    found = joint.find("axis")
    axis = np.array([1.0, 0.0, 0.0]) if found is None else numbers(found, "xyz")
    length = float(np.linalg.norm(axis))
    if not length > 0.0:
        raise InputError("its <axis> has no length")
    x, y, z = (float(part) for part in axis / length)
    own: Frame = np.eye(3), position * np.array([x, y, z])
    if joint.get("type") in TURNS:
        own = about((x, y, z), position), np.zeros(3)
    turn, place = within(origin(joint), own)
    there = joint.find("origin")
    there = ElementTree.SubElement(joint, "origin") if there is None else there
    there.set("xyz", " ".join(repr(float(part)) for part in place))
    there.set("rpy", " ".join(map(repr, roll_pitch_yaw(turn))))
