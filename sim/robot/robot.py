"""The robot that is held: the one that ships, or a user's URDF. Where its handles are. Pure."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ..basics.errors import InputError
from ..basics.file_names import FileName
from ..basics.frames import Vector
from ..basics.lists import require_entries
from ..basics.registry import did_you_mean
from ..basics.validators import Range, require, require_range, require_text
from ..urdf.meshes import read_mesh
from ..urdf.posture import put_joints
from ..urdf.read import left_right_swapped, link_frames, read_robot
from ..urdf.rigid import Rigid, lump
from ..urdf.solids import Solid, robot_outline, robot_solids
from ..world.outline import Outline, disc
from .shipped import BASE_RADIUS, CAMERA_PLACE

HANDLES_APART = 0.44
"""Distance of the two hands on one handle bar, m (inferred: shoulder breadth)."""
OFFSET: Range = (-3.0, 3.0, "m")
"""Of a handle from its link, each way (inferred: the size of what two walk with)."""
JOINT: Range = (-100.0, 100.0, "rad or m")
"""Where a joint may be; the file has narrower limits of its own."""
DRAWN = (".obj", ".stl", ".dae")
"""Mesh files that the engine draws."""


@dataclass(frozen=True)
class RobotParameters:
    """Which robot.

    Parameters
    ----------
    urdf : FileName, optional
        Path of a URDF; its root link moves on the floor plane, x forward and z up, its own
        joints are locked. None is the robot that ships.
    handle : str
        Name of the link at whose origin it is held.
    handle_offset : (x, y, z)
        Where it is held from there, in the axes of that link, m.
    joints : mapping of str to float
        Where its own joints are locked, by their names: rad, or m for one that slides; the
        others at zero, or where they follow one of these.
    camera : str
        Name of the link at whose origin it sees. A robot without a link "camera" sees from the
        front of its outline, as high up as its shapes reach.

    Raises
    ------
    InputError
        If one is no text, or a number is none or makes no sense. What is not in the file is
        refused by `robot_of`.
    """

    urdf: FileName | None = None
    handle: str = "handle"
    camera: str = "camera"
    handle_offset: Vector = (0.0, 0.0, 0.0)
    joints: Mapping[str, float] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        right = self.urdf is None or (isinstance(self.urdf, str | os.PathLike) and self.urdf != "")
        require(right, "urdf", self.urdf, "the path of a URDF file is expected")
        for name in ("handle", "camera"):
            require_text(name, getattr(self, name), "the name of a link")
        require_entries(self, ("handle_offset",), 3, OFFSET)
        what = "positions of joints by their names are expected"
        require(isinstance(self.joints, Mapping), "joints", self.joints, what)
        for joint, position in self.joints.items():
            require_text("joints", joint, "the name of a joint")
            require_range(("joints", joint), position, JOINT)


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
    outline : Outline
        Around its collision shapes, or if it has none around what is visible of it.
    camera : (x, y, z)
        Where it sees from, base axes, m.
    solids : tuple of Solid
        The shapes within the outline, one by one.
    """

    rigid: Rigid
    handle: Vector
    handles: tuple[Vector, ...]
    urdf: str
    outline: Outline
    camera: Vector
    solids: tuple[Solid, ...]


def robot_of(parameters: RobotParameters, hand: str, coupling: str) -> Robot:
    """Return the robot for a holding hand and a coupling.

    Raises
    ------
    InputError
        If the file or a named link is missing, a mesh cannot be read, or the robot has no mass.
    """
    try:
        return _robot_of(parameters, hand, coupling)
    except InputError as error:
        raise error.inside("robot") from error


def _robot_of(parameters: RobotParameters, hand: str, coupling: str) -> Robot:
    """Return the robot; errors say where in its parameters they are."""
    if parameters.urdf is None:
        rear = hand == "both" or coupling == "stretcher"
        name = "base_rear.urdf" if rear else "base.urdf"
        root = ElementTree.fromstring(
            files("cowalk.sim.robot.models").joinpath(name).read_text("utf-8")
        )
        if hand == "right":
            root = left_right_swapped(root)
    else:
        root = read_robot(Path(parameters.urdf))
        _absolute_meshes(root, Path(parameters.urdf).resolve().parent)
    put_joints(root, parameters.joints)
    rigid = lump(root)
    _place_of(rigid, "handle", parameters.handle)
    turn, origin = link_frames(root)[parameters.handle]
    x, y, z = (float(part) for part in origin + turn @ np.array(parameters.handle_offset))
    handle = x, y, z
    handles = two_hands(handle) if hand == "both" else (handle,)
    # A robot without any shape is taken for one as large as that which ships.
    solids = robot_solids(root)
    outline, top = (disc(BASE_RADIUS), CAMERA_PLACE[2]) if not solids else robot_outline(solids)
    camera = (outline.box[1], 0.0, top)
    if parameters.camera != RobotParameters.camera or parameters.camera in rigid.places:
        camera = _place_of(rigid, "camera", parameters.camera)
    return Robot(rigid, handle, handles, _locked(root), outline, camera, solids)


def _place_of(rigid: Rigid, parameter: str, name: str) -> Vector:
    if name not in rigid.places:
        hint = did_you_mean(name, sorted(rigid.places))
        raise InputError(f"{parameter}: no link {name!r}; {hint}", (parameter,))
    return rigid.places[name]


def two_hands(handle: Vector) -> tuple[Vector, Vector]:
    """Return where two hands hold a bar across at a handle, left hand first, m."""
    x, y, z = handle
    return (x, y + HANDLES_APART / 2.0, z), (x, y - HANDLES_APART / 2.0, z)


def _absolute_meshes(root: ElementTree.Element, folder: Path) -> None:
    """Give meshes their absolute paths.

    Raises
    ------
    InputError
        If there is no such file, it cannot be read, or is to be seen and of a kind that is not
        drawn.
    """
    for link in root.findall("link"):
        for kind in ("collision", "visual"):
            for mesh in link.findall(f"{kind}/geometry/mesh"):
                given = mesh.get("filename", "")
                path = _mesh_path(given, folder)
                fault = f'link {link.get("name", "")!r}, <{kind}>: <mesh filename="{given}">'
                if not path.is_file():
                    raise InputError(f"{fault}: there is no mesh {str(path)!r}")
                if kind == "visual" and path.suffix.lower() not in DRAWN:
                    raise InputError(f"{fault}: must be one of {', '.join(DRAWN)} to be drawn")
                mesh.set("filename", str(path))
                try:
                    read_mesh(str(path))
                except ValueError as error:
                    raise InputError(f"link {link.get('name', '')!r}: {error}") from error


def _mesh_path(name: str, folder: Path) -> Path:
    if name.startswith("package://"):
        # Named from the folder that holds the package, which the file itself lies in.
        inside = name.removeprefix("package://")
        holders = (place for place in (folder, *folder.parents) if (place / inside).is_file())
        return next(holders, folder) / inside
    return folder / name.removeprefix("file://")


def _locked(root: ElementTree.Element) -> str:
    """Return the robot with its joints fixed where they are, for who draws it.

    Without textures, which would be further files.
    """
    for material in root.iter("material"):
        for texture in material.findall("texture"):
            material.remove(texture)
    for joint in root.findall("joint"):
        joint.set("type", "fixed")
        for part in list(joint):
            if part.tag not in ("parent", "child", "origin"):
                joint.remove(part)
    return ElementTree.tostring(root, encoding="unicode")
