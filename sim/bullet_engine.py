"""PyBullet itself: a quiet import, clients, bodies on planar joints, and the grip's reaction.

PyBullet has no type stubs; its functions are reached through `engine`, whose attributes are Any.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import importlib
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree

from .errors import InputError


@contextmanager
def quiet(*descriptors: int) -> Iterator[None]:
    """Keep what C code prints out of the given file descriptors (1 output, 2 error).

    They are pointed at the null device meanwhile. C's own buffers are flushed before they are
    pointed back, else the text would come out when the process ends.
    """
    c_library = ctypes.CDLL(None) if os.name == "posix" else ctypes.CDLL("msvcrt")
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, OSError, ValueError):  # none, or closed
            stream.flush()
    c_library.fflush(None)
    kept: dict[int, int] = {}
    null = os.open(os.devnull, os.O_WRONLY)
    try:
        for descriptor in descriptors:
            with suppress(OSError):  # the process was started without it
                kept[descriptor] = os.dup(descriptor)
                os.dup2(null, descriptor)
        yield
    finally:
        c_library.fflush(None)
        for descriptor, copy in kept.items():
            os.dup2(copy, descriptor)
            os.close(copy)
        os.close(null)


with quiet(1, 2):  # it announces its build time
    engine = importlib.import_module("pybullet")


def connect(gui: bool = False) -> int:
    """Open a world of one's own and return its client id.

    Raises
    ------
    InputError
        If a window is asked for and there is no display.
    """
    if gui and sys.platform.startswith("linux") and not _display_opens():
        raise InputError(  # the engine would end the whole process
            f"no window can be opened: display {os.environ.get('DISPLAY', '')!r} does not answer; "
            "set DISPLAY, or run without the window"
        )
    with quiet(1):
        client: int = engine.connect(engine.GUI if gui else engine.DIRECT)
    if client < 0:
        raise InputError("no window can be opened: another one is open in this process")
    return client


def _display_opens() -> bool:
    name = ctypes.util.find_library("X11")
    if name is None:
        return False
    x11 = ctypes.CDLL(name)
    x11.XOpenDisplay.restype = ctypes.c_void_p
    display = x11.XOpenDisplay(None)
    if display is None:
        return False
    x11.XCloseDisplay(ctypes.c_void_p(display))
    return True


def disconnect(client: int) -> None:
    """Free a client and everything in it; one that is gone already is no error."""
    if engine.isConnected(client):
        with quiet(1):
            engine.disconnect(client)


def load(client: int, file: str, flags: int = 0, without: str = "") -> int:
    """Load a URDF of `cowalk.sim.bodies` with its ground link held, and return the body id.

    Parameters
    ----------
    client : int
        Where to load it.
    file : str
        Name of the file.
    flags : int
        Of the engine's `loadURDF`.
    without : str
        A massless link at the end of a fixed joint, left out together with that joint.
    """
    root = ElementTree.fromstring(files("cowalk.sim.bodies").joinpath(file).read_text("utf-8"))
    for part in root.findall(f"link[@name='{without}']"):
        root.remove(part)
    for part in root.findall(f"joint/child[@link='{without}']/.."):
        root.remove(part)
    with TemporaryDirectory() as folder, quiet(1):
        path = Path(folder, file)
        ElementTree.ElementTree(root).write(path)
        body: int = engine.loadURDF(
            str(path), useFixedBase=True, flags=flags, physicsClientId=client
        )
    return body


@dataclass(frozen=True)
class Body:
    """A body ready to be driven: nothing but the forces given to it act on its joints.

    Attributes
    ----------
    body : int
    joints : tuple of int
        Indices of the moving joints, in the order asked for.
    origins : dict of str to (x, y, z)
        Where each link's joint is with all joints at zero, fixed links included, m.
    mass, yaw_inertia : float
        Of all links, kg, and of the link behind the joint ``yaw`` about its centre, kg m^2.
    grip_link : int
        Link that carries the grip.
    grip_pivot : (x, y, z)
        Where the grip is in the inertial frame of that link, m.
    """

    body: int
    joints: tuple[int, ...]
    origins: dict[str, tuple[float, float, float]]
    mass: float
    yaw_inertia: float
    grip_link: int
    grip_pivot: tuple[float, float, float]


def load_driven(client: int, file: str, grip: str, joints: tuple[str, ...]) -> Body:
    """Load a body for the physics: no pictures, no collision, no damping, no motors.

    It is loaded twice: the link that marks the grip tells where it is, but without the fixed
    links of both bodies a step takes 15 % less. (The engine's own URDF_MERGE_FIXED_LINKS would
    do, were it not to move the parent's centre of mass to its joint: bulletphysics/bullet3#4683.)

    Parameters
    ----------
    client : int
        Where to load it.
    file : str
        URDF in `cowalk.sim.bodies`.
    grip : str
        Massless link, fixed to a moving one, that marks where it is held.
    joints : tuple of str
        Names of all moving joints, ``yaw`` among them.
    """
    # Without the second flag the engine makes up inertias from the (absent) collision shapes.
    bare = engine.URDF_IGNORE_VISUAL_SHAPES | engine.URDF_USE_INERTIA_FROM_FILE
    whole = load(client, file, bare)
    info = [
        engine.getJointInfo(whole, link, client)
        for link in range(engine.getNumJoints(whole, client))
    ]
    origins = {
        i[12].decode(): engine.getLinkState(whole, link, 0, 1, client)[4]
        for link, i in enumerate(info)
    }
    carrier = info[list(origins).index(grip)][16]
    centre = engine.getLinkState(whole, carrier, 0, 1, client)
    pivot, _ = engine.multiplyTransforms(
        *engine.invertTransform(*centre[:2]), origins[grip], (0.0, 0.0, 0.0, 1.0)
    )
    engine.removeBody(whole, client)

    body = load(client, file, bare, without=grip)
    count = engine.getNumJoints(body, client)
    index = {engine.getJointInfo(body, joint, client)[1]: joint for joint in range(count)}
    for link in range(-1, count):
        engine.changeDynamics(
            body,
            link,
            linearDamping=0.0,
            angularDamping=0.0,
            jointDamping=0.0,
            physicsClientId=client,
        )
        engine.setCollisionFilterGroupMask(body, link, 0, 0, client)
        if link >= 0:
            engine.setJointMotorControl2(
                body, link, engine.VELOCITY_CONTROL, force=0.0, physicsClientId=client
            )
    dynamics = [engine.getDynamicsInfo(body, link, client) for link in range(count)]
    return Body(
        body=body,
        joints=tuple(index[name.encode()] for name in joints),
        origins=origins,
        mass=sum(d[0] for d in dynamics),
        yaw_inertia=dynamics[index[b"yaw"]][2][2],
        grip_link=index[info[carrier][1]],
        grip_pivot=pivot,
    )


def force_on_parent(kind: int, reaction: tuple[float, ...]) -> tuple[float, float, float]:
    """Convert what `getConstraintState` reports to the child's force on the parent.

    The engine reports the force on the parent for JOINT_FIXED, and the force on the child for
    JOINT_POINT2POINT (a mass hanging from a held parent reads -m g and +m g).

    Parameters
    ----------
    kind : int
        ``engine.JOINT_FIXED`` or ``engine.JOINT_POINT2POINT``.
    reaction : tuple of float
        As reported, N, world axes; torques after the first three are ignored.

    Returns
    -------
    (fx, fy, fz)
        N, world axes.
    """
    if kind == engine.JOINT_POINT2POINT:
        return -reaction[0], -reaction[1], -reaction[2]
    return reaction[0], reaction[1], reaction[2]
