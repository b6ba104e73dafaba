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
from importlib.resources import as_file, files

from .errors import InputError


@contextmanager
def quiet() -> Iterator[None]:
    """Keep what C code prints off standard output, which belongs to the user's JSON.

    File descriptor 1 is pointed at the null device; C's own buffer is flushed before it is
    pointed back, else the text would come out when the process ends.
    """
    c_library = ctypes.CDLL(None) if os.name == "posix" else ctypes.CDLL("msvcrt")
    with suppress(AttributeError, OSError, ValueError):
        sys.stdout.flush()
    c_library.fflush(None)
    try:
        kept = os.dup(1)
    except OSError:  # started without a standard output
        yield
        return
    try:
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.close(null)
        yield
    finally:
        c_library.fflush(None)
        os.dup2(kept, 1)
        os.close(kept)


with quiet():
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
    with quiet():
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
        with quiet():
            engine.disconnect(client)


def load(client: int, file: str, flags: int = 0) -> int:
    """Load a URDF of `cowalk.sim.bodies` with its ground link held, and return the body id."""
    with as_file(files("cowalk.sim.bodies") / file) as path, quiet():
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

    It is loaded twice: the fixed links tell where things are, but a body without them steps
    15 % faster.

    Parameters
    ----------
    client : int
        Where to load it.
    file : str
        URDF in `cowalk.sim.bodies`.
    grip : str
        Link by which it is held; fixed links between it and a moving one are followed.
    joints : tuple of str
        Names of all moving joints, ``yaw`` among them.
    """
    # Without the second flag the engine makes up inertias from the (absent) collision shapes.
    bare = engine.URDF_IGNORE_VISUAL_SHAPES | engine.URDF_USE_INERTIA_FROM_FILE
    whole = load(client, file, bare)
    info = [
        engine.getJointInfo(whole, j, client) for j in range(engine.getNumJoints(whole, client))
    ]
    links = [i[12].decode() for i in info]
    origins = {link: engine.getLinkState(whole, j, 0, 1, client)[4] for j, link in enumerate(links)}
    carrier = links.index(grip)
    while info[carrier][2] == engine.JOINT_FIXED:
        carrier = info[carrier][16]
    carrier_joint = info[carrier][1]
    engine.removeBody(whole, client)

    body = load(client, file, bare | engine.URDF_MERGE_FIXED_LINKS)
    count = engine.getNumJoints(body, client)
    index = {engine.getJointInfo(body, j, client)[1]: j for j in range(count)}
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
    grip_link = index[carrier_joint]
    centre = engine.getLinkState(body, grip_link, 0, 1, client)
    pivot, _ = engine.multiplyTransforms(
        *engine.invertTransform(*centre[:2]), origins[grip], (0.0, 0.0, 0.0, 1.0)
    )
    return Body(
        body=body,
        joints=tuple(index[name.encode()] for name in joints),
        origins=origins,
        mass=sum(d[0] for d in dynamics),
        yaw_inertia=dynamics[index[b"yaw"]][2][2],
        grip_link=grip_link,
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
