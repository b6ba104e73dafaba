"""Writing URDF: plain chains of links, hinges and slides on the floor plane. Pure."""

from __future__ import annotations

from ..basics.frames import Vector

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
