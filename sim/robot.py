"""The robot that is held: the one that ships, or a user's URDF. Where its handles are. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from xml.etree import ElementTree

from .errors import InputError
from .registry import did_you_mean
from .urdf import Rigid, Vector, lump, mirrored, read_robot

HANDLES_APART = 0.44
"""Distance of the two hands on one handle bar, m (inferred: shoulder breadth)."""


@dataclass(frozen=True)
class RobotParameters:
    """Which robot.

    Parameters
    ----------
    urdf : str, optional
        Path of a URDF; its root link moves on the floor plane, x forward and z up, its own
        joints are locked at zero. None is the robot that ships.
    handle : str
        Name of the link at whose origin it is held.
    """

    urdf: str | None = None
    handle: str = "handle"


@dataclass(frozen=True)
class Robot:
    """A robot as the physics and the pictures need it.

    Attributes
    ----------
    rigid : Rigid
    handle : (x, y, z)
        Where it is held, base axes, m.
    handles : tuple of (x, y, z)
        Where each hand holds, in order left, right.
    urdf : str
        Its pictures, mesh paths made absolute.
    """

    rigid: Rigid
    handle: Vector
    handles: tuple[Vector, ...]
    urdf: str


def robot_of(parameters: RobotParameters, hand: str, coupling: str) -> Robot:
    """Return the robot for a holding hand and a coupling.

    Raises
    ------
    InputError
        If the file or the handle link is missing, or the robot has no mass.
    """
    if parameters.urdf is None:
        rear = hand == "both" or coupling == "stretcher"
        name = "base_rear.urdf" if rear else "base.urdf"
        root = ElementTree.fromstring(files("cowalk.sim.bodies").joinpath(name).read_text("utf-8"))
        if hand == "right":
            root = mirrored(root)
    else:
        root = read_robot(Path(parameters.urdf))
        _absolute_meshes(root, Path(parameters.urdf).resolve().parent)
    rigid = lump(root)
    if parameters.handle not in rigid.places:
        known = sorted(rigid.places)
        raise InputError(
            f"robot.handle: no link {parameters.handle!r}; {did_you_mean(parameters.handle, known)}"
        )
    handle = rigid.places[parameters.handle]
    handles = two_hands(handle) if hand == "both" else (handle,)
    return Robot(rigid, handle, handles, ElementTree.tostring(root, encoding="unicode"))


def two_hands(handle: Vector) -> tuple[Vector, Vector]:
    """Return where two hands hold a bar across at a handle, left hand first, m."""
    x, y, z = handle
    return (x, y + HANDLES_APART / 2.0, z), (x, y - HANDLES_APART / 2.0, z)


def _absolute_meshes(root: ElementTree.Element, folder: Path) -> None:
    for mesh in root.iter("mesh"):
        name = mesh.get("filename", "")
        if not name.startswith("package://"):
            mesh.set("filename", str(folder / name.removeprefix("file://")))
