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
    joints : dict of str to int
        Index of each moving joint, which is also that of the link behind it.
    origins : dict of str to (x, y, z)
        Where each link's joint is with all joints at zero, fixed links included, m.
    grip_link : int
    grip_pivot : (x, y, z)
        Where it is held, in the inertial frame of ``grip_link``, m.
    """

    body: int
    joints: dict[str, int]
    origins: dict[str, tuple[float, float, float]]
    grip_link: int
    grip_pivot: tuple[float, float, float]


def load_driven(client: int, file: str, grip: str) -> Body:
    """Load a body for the physics: no pictures, no collision, no damping, no motors.

    It is loaded twice: the fixed links tell where things are, but a body without them steps
    15 % faster.

    Parameters
    ----------
    client : int
    file : str
        URDF in `cowalk.sim.bodies`.
    grip : str
        Link by which it is held.
    """
    # Without the second flag the engine makes up inertias from the (absent) collision shapes.
    bare = engine.URDF_IGNORE_VISUAL_SHAPES | engine.URDF_USE_INERTIA_FROM_FILE
    whole = load(client, file, bare)
    origins, parents = {}, {}
    for joint in range(engine.getNumJoints(whole, client)):
        info = engine.getJointInfo(whole, joint, client)
        state = engine.getLinkState(whole, joint, 0, 1, client)
        name = info[12].decode()
        origins[name] = state[4]
        parents[name] = (
            engine.getJointInfo(whole, info[16], client)[12].decode()
            if (info[2] == engine.JOINT_FIXED and info[16] >= 0)
            else None
        )
    engine.removeBody(whole, client)
    carrier = grip
    while (parent := parents[carrier]) is not None:
        carrier = parent

    body = load(client, file, bare | engine.URDF_MERGE_FIXED_LINKS)
    joints, grip_link = {}, -1
    for joint in range(-1, engine.getNumJoints(body, client)):
        engine.changeDynamics(
            body,
            joint,
            linearDamping=0.0,
            angularDamping=0.0,
            jointDamping=0.0,
            physicsClientId=client,
        )
        engine.setCollisionFilterGroupMask(body, joint, 0, 0, client)
        if joint >= 0:
            info = engine.getJointInfo(body, joint, client)
            joints[info[1].decode()] = joint
            if info[12].decode() == carrier:
                grip_link = joint
            engine.setJointMotorControl2(
                body, joint, engine.VELOCITY_CONTROL, force=0.0, physicsClientId=client
            )
    centre = engine.getLinkState(body, grip_link, 0, 1, client)
    to_link = engine.invertTransform(centre[0], centre[1])
    pivot, _ = engine.multiplyTransforms(*to_link, origins[grip], (0.0, 0.0, 0.0, 1.0))
    return Body(body, joints, origins, grip_link, pivot)


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
