"""How the human looks: a figure of plain shapes whose legs step and whose free arm swings. Pure.

Only the viewer poses it; the physics knows a trunk and the arms that hold on.
"""

from __future__ import annotations

import math

from ..basics.frames import Vector
from ..urdf.chain import hinge
from .anthropometry import (
    ANKLE_HEIGHT,
    EYE_HEIGHT,
    HIP_HEIGHT,
    SHOULDER_HEIGHT,
    WINTER,
    BodyParameters,
    girth,
)
from .arm import Arm
from .gait import step_frequency
from .human_body import HumanBody

SKIN, HAIR, SHIRT, TROUSERS, SHOES = (
    "0.87 0.68 0.54 1",
    "0.25 0.16 0.10 1",
    "0.75 0.22 0.20 1",
    "0.20 0.25 0.40 1",
    "0.12 0.10 0.10 1",
)
HALF_HIPS = 0.050
"""Hip joints to the side of the middle, share of the height (inferred)."""
STANCE = 0.6
"""Share of the stride for which a foot is on the floor (Winter 2009, ch. 2: about 60 %)."""
LIFT = 0.035
"""How high a swinging ankle rises, share of the height (inferred)."""
CROUCH = 0.012
"""How much lower than straight-legged the hips are, share of the height (inferred)."""
ARM_SWING = 0.45
"""Half the swing of a free arm at 1.3 m/s, rad (inferred)."""


def capsule(start: Vector, end: Vector, radius: float, colour: str) -> str:
    """Return a <visual> that reaches from one point to another."""
    dx, dy, dz = (b - a for a, b in zip(start, end, strict=True))
    length = math.sqrt(dx * dx + dy * dy + dz * dz)
    pitch, yaw = math.acos(max(-1.0, min(1.0, dz / length))), math.atan2(dy, dx)
    middle = " ".join(f"{(a + b) / 2.0:.5f}" for a, b in zip(start, end, strict=True))
    return (
        f'<visual><origin xyz="{middle}" rpy="0 {pitch:.5f} {yaw:.5f}"/><geometry>'
        f'<capsule radius="{radius:.5f}" length="{length:.5f}"/></geometry>'
        f"{_paint(colour)}</visual>"
    )


def ball(place: Vector, radius: float, colour: str) -> str:
    """Return a <visual> sphere."""
    x, y, z = place
    return (
        f'<visual><origin xyz="{x:.5f} {y:.5f} {z:.5f}"/><geometry>'
        f'<sphere radius="{radius:.5f}"/></geometry>{_paint(colour)}</visual>'
    )


def _paint(colour: str) -> str:
    return f'<material name="c{colour.replace(" ", "_")}"><color rgba="{colour}"/></material>'


def _link(name: str, *visuals: str) -> str:
    return (
        f'<link name="{name}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" '
        f'ixy="0" ixz="0" iyz="0"/></inertial>{"".join(visuals)}</link>'
    )


def _pitch(name: str, parent: str, child: str, place: Vector) -> str:
    return hinge(name, parent, child, place).replace('<axis xyz="0 0 1"/>', '<axis xyz="0 1 0"/>')


def figure_urdf(human: HumanBody) -> str:
    """Return the figure as a URDF; its origin is on the floor below the trunk."""
    body = human.parameters
    parts = [_link("trunk", *_trunk(body))]
    for side, arm in zip(body.sides, human.arms, strict=True):
        parts += _holding_arm(body, side, arm)
    for side in ("left", "right"):
        if side not in body.sides:
            parts += _free_arm(body, side)
        parts += _leg(body, side)
    return f'<robot name="human">{"".join(parts)}</robot>'


def _trunk(body: BodyParameters) -> list[str]:
    """Return trunk and head; sizes are inferred, to look like somebody of 1.75 m."""
    k = body.height / 1.75
    wide = k * girth(body)

    def at(x: float, y: float, z: float) -> Vector:
        return k * x, k * y, k * z

    def wider(x: float, y: float, z: float) -> Vector:
        return wide * x, wide * y, k * z

    eyes = EYE_HEIGHT * 1.75
    return [
        capsule(wider(0.0, -0.085, 1.06), wider(0.0, -0.085, 1.34), wide * 0.092, SHIRT),
        capsule(wider(0.0, 0.085, 1.06), wider(0.0, 0.085, 1.34), wide * 0.092, SHIRT),
        capsule(wider(0.012, 0.0, 1.0), wider(0.012, 0.0, 1.36), wide * 0.10, SHIRT),
        capsule(wider(0.0, -0.15, 1.405), wider(0.0, 0.15, 1.405), wide * 0.060, SHIRT),
        capsule(wider(0.0, -0.072, 0.945), wider(0.0, 0.072, 0.945), wide * 0.105, TROUSERS),
        capsule(at(0.0, 0.0, 1.42), at(0.01, 0.0, 1.56), k * 0.050, SKIN),
        ball(at(0.02, 0.0, 1.645), k * 0.100, SKIN),
        ball(at(0.025, 0.0, 1.605), k * 0.082, SKIN),
        ball(at(-0.006, 0.0, 1.665), k * 0.105, HAIR),
        ball(at(0.125, 0.0, 1.622), k * 0.016, SKIN),
        ball(at(0.106, 0.035, eyes + 0.015), k * 0.012, SHOES),
        ball(at(0.106, -0.035, eyes + 0.015), k * 0.012, SHOES),
    ]


def _holding_arm(body: BodyParameters, side: str, arm: Arm) -> list[str]:
    k = body.height / 1.75
    upper, fore = arm.upper, arm.fore
    elbow, grip = (upper.length, 0.0, -upper.drop), (fore.length, 0.0, -fore.drop)
    wrist = (0.78 * grip[0], 0.0, 0.78 * grip[2])
    shoulder = (*arm.shoulder, arm.height)
    return [
        _link(
            f"upper_arm_{side}",
            ball((0.0, 0.0, -0.01 * k), k * 0.058, SHIRT),
            capsule((0.0, 0.0, 0.0), elbow, k * 0.044, SHIRT),
        ),
        _link(
            f"forearm_{side}",
            capsule((0.0, 0.0, 0.0), wrist, k * 0.036, SKIN),
            capsule(wrist, grip, k * 0.030, SKIN),
            ball(grip, k * 0.043, SKIN),
        ),
        hinge(f"shoulder_{side}", "trunk", f"upper_arm_{side}", shoulder),
        hinge(f"elbow_{side}", f"upper_arm_{side}", f"forearm_{side}", elbow),
    ]


def _free_arm(body: BodyParameters, side: str) -> list[str]:
    k, sign = body.height / 1.75, 1.0 if side == "left" else -1.0
    upper = WINTER["upper_arm"].length * body.height
    fore = WINTER["forearm"].length * body.height
    shoulder = (0.0, sign * 0.20 * k, SHOULDER_HEIGHT * body.height - 0.01)
    elbow = (-0.02 * k, sign * 0.045 * k, -upper)
    wrist = (elbow[0] + 0.35 * fore, elbow[1] + sign * 0.01 * k, elbow[2] - 0.93 * fore)
    hand = (wrist[0] + 0.04 * k, wrist[1], wrist[2] - 0.07 * k)
    return [
        _link(
            f"free_arm_{side}",
            ball((0.0, 0.0, -0.01 * k), k * 0.056, SHIRT),
            capsule((0.0, 0.0, -0.02 * k), elbow, k * 0.044, SHIRT),
            capsule(elbow, wrist, k * 0.036, SKIN),
            capsule(wrist, hand, k * 0.032, SKIN),
        ),
        _pitch(f"swing_{side}", "trunk", f"free_arm_{side}", shoulder),
    ]


def _leg(body: BodyParameters, side: str) -> list[str]:
    k, sign = body.height / 1.75, 1.0 if side == "left" else -1.0
    thigh, shank = (WINTER[name].length * body.height for name in ("thigh", "shank"))
    foot = WINTER["foot"].length * body.height
    hip = (0.0, sign * HALF_HIPS * body.height, (HIP_HEIGHT - CROUCH) * body.height)
    sole = -ANKLE_HEIGHT * body.height + 0.036 * k
    return [
        _link(f"thigh_{side}", capsule((0.0, 0.0, 0.0), (0.0, 0.0, -thigh), k * 0.073, TROUSERS)),
        _link(f"shank_{side}", capsule((0.0, 0.0, 0.0), (0.0, 0.0, -shank), k * 0.052, TROUSERS)),
        _link(
            f"foot_{side}",
            capsule((-0.22 * foot, 0.0, sole), (0.70 * foot, 0.0, sole), k * 0.038, SHOES),
        ),
        _pitch(f"hip_{side}", "trunk", f"thigh_{side}", hip),
        _pitch(f"knee_{side}", f"thigh_{side}", f"shank_{side}", (0.0, 0.0, -thigh)),
        _pitch(f"ankle_{side}", f"shank_{side}", f"foot_{side}", (0.0, 0.0, -shank)),
    ]


def pose(body: BodyParameters, phase: float, speed: float) -> dict[str, float]:
    """Return the angles of legs and free arms, rad, by joint name.

    Parameters
    ----------
    body : BodyParameters
    phase : float
        Of the stride, rad; the left foot is midway through its stance at pi/2.
    speed : float
        m/s, forward.
    """
    pace = max(0.0, speed)
    stride = 2.0 / step_frequency(pace) if pace > 0.05 else 0.0
    travel = STANCE * pace * stride
    lift = LIFT * body.height * min(1.0, pace / 0.4)
    angles: dict[str, float] = {}
    for side, lead in (("left", 0.0), ("right", 0.5)):
        share = (phase / math.tau - 0.25 + lead + 0.5) % 1.0 - 0.5
        if abs(share) <= STANCE / 2.0:
            ahead, up = -travel * share / STANCE, 0.0
        else:
            swing = (share - STANCE / 2.0) % 1.0 / (1.0 - STANCE)
            ahead, up = -travel / 2.0 * math.cos(math.pi * swing), lift * math.sin(math.pi * swing)
        hip, knee, ankle = leg_angles(body, ahead, up)
        angles |= {f"hip_{side}": hip, f"knee_{side}": knee, f"ankle_{side}": ankle}
        # Arms swing against the leg of their own side.
        swing = ahead / (travel / 2.0) if travel else 0.0
        angles[f"swing_{side}"] = ARM_SWING * min(1.0, pace / 1.3) * swing
    return angles


def leg_angles(body: BodyParameters, ahead: float, up: float) -> tuple[float, float, float]:
    """Return hip, knee and ankle angle (rad, positive backwards) that put a foot somewhere.

    Parameters
    ----------
    body : BodyParameters
    ahead, up : float
        Of the ankle from where it is when standing, m. Where the leg is too short the heel
        comes off the floor.
    """
    thigh, shank = (WINTER[name].length * body.height for name in ("thigh", "shank"))
    down = (HIP_HEIGHT - CROUCH - ANKLE_HEIGHT) * body.height - up
    longest = 0.999 * (thigh + shank)
    reach = math.hypot(ahead, down)
    toe = 0.0
    if reach > longest:
        lower = math.sqrt(max(longest**2 - ahead**2, 0.0))
        foot = WINTER["foot"].length * body.height
        # Behind the heel rises over the ball of the foot, ahead the toes come up.
        toe = math.copysign(math.asin(min(1.0, (down - lower) / (0.7 * foot))), -ahead)
        down, reach = lower, longest
    lean = math.atan2(ahead, down)
    bend = math.acos((thigh**2 + reach**2 - shank**2) / (2.0 * thigh * reach))
    knee = math.pi - math.acos((thigh**2 + shank**2 - reach**2) / (2.0 * thigh * shank))
    hip = -(lean + bend)
    return hip, knee, toe - hip - knee
