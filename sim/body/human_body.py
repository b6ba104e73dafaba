"""The human that the physics moves: trunk with head and legs, and the arms that hold on. Pure."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..basics.frames import Vector
from ..urdf.chain import hinge, link, planar, slider
from ..world.outline import Outline, across, bar
from .anthropometry import EYE_HEIGHT, BodyParameters, trunk_breadth, trunk_depth, yaw_inertia
from .arm import ELBOW_RANGE, SHOULDER_RANGE, Arm, arm_of

BESIDE = (0.25, 0.15)
"""Where a single hand rests, ahead of its shoulder and outwards, m: at 1.75 m and a handle at
`USUAL_HANDLE_HEIGHT`; others bend their elbow as much (inferred: led by hand)."""
USUAL_HANDLE_HEIGHT = 1.04
ARM_RADIUS = 0.04
"""m (inferred)."""
RELAXED_ELBOW = -1.9
"""Elbow angle of both hands on a bar ahead, rad: midway between straight and fully bent, so that
the arms can give way to either side (inferred)."""


@dataclass(frozen=True)
class HumanBody:
    """Arms, mass and place of a human who holds given handles.

    Attributes
    ----------
    parameters : BodyParameters
    arms : tuple of Arm
    pivots : tuple of (x, y, z)
        Where each arm's hand grips, from the forearm's centre of mass, forearm axes, m.
    place : (x, y, theta)
        Where the trunk walks, in the axes of what is held: m, m, rad.
    rest : tuple of (x, y)
        Where each hand rests, trunk axes, m.
    """

    parameters: BodyParameters
    arms: tuple[Arm, ...]
    pivots: tuple[Vector, ...]
    place: Vector
    rest: tuple[tuple[float, float], ...]

    @property
    def posture(self) -> tuple[float, ...]:
        """Shoulder and elbow angle of each arm at rest, rad."""
        return tuple(
            angle
            for arm, rest in zip(self.arms, self.rest, strict=True)
            for angle in arm.angles(rest)
        )

    def holding(
        self, sway: tuple[float, float, float, float]
    ) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return the arms' angles (rad) and rates (rad/s) with a swaying trunk and resting hands.

        Parameters
        ----------
        sway : (x, y, vx, vy)
            Of the trunk from its place, in the axes of what is held, m and m/s.

        Raises
        ------
        InputError
            If a hand is out of reach.
        """
        x, y, vx, vy = sway
        angles: tuple[float, ...] = ()
        rates: tuple[float, ...] = ()
        for arm, (ahead, aside) in zip(self.arms, self.rest, strict=True):
            bent = arm.angles((ahead - x, aside - y))
            angles += bent
            rates += tuple(np.linalg.solve(arm.jacobian(*bent), (-vx, -vy)).tolist())
        return angles, rates

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the moving joints, in the order of a state."""
        arms = (f"{joint}_{side}" for side in self.parameters.sides for joint in ARM_JOINTS)
        return ("x", "y", "yaw", *arms)

    def urdf(self, hands_rise: bool = False) -> str:
        """Return the body as a URDF without pictures: nothing in it but what moves.

        Parameters
        ----------
        hands_rise : bool
            Whether a hand follows its handle up and down (link ``hand_left``, joint
            ``lift_left``), so that it neither carries nor holds down what stands on a floor.
        """
        body = self.parameters
        held = sum(arm.upper.mass + arm.fore.mass for arm in self.arms)
        parts = [link("trunk", body.mass - held, (0.0, 0.0, 0.57 * body.height), yaw_inertia(body))]
        for side, arm in zip(body.sides, self.arms, strict=True):
            upper, fore = arm.upper, arm.fore
            shoulder = (*arm.shoulder, arm.height)
            elbow = (upper.length, 0.0, -upper.drop)
            limits = [
                (low, high) if arm.side > 0.0 else (-high, -low)
                for low, high in (SHOULDER_RANGE, ELBOW_RANGE)
            ]
            for name, part in (("upper_arm", upper), ("forearm", fore)):
                share = part.centre / part.length
                centre = (part.centre, 0.0, -share * part.drop)
                parts.append(link(f"{name}_{side}", part.mass, centre, part.inertia))
            parts.append(
                hinge(f"shoulder_{side}", "trunk", f"upper_arm_{side}", shoulder, limits[0])
            )
            parts.append(
                hinge(f"elbow_{side}", f"upper_arm_{side}", f"forearm_{side}", elbow, limits[1])
            )
            if hands_rise:
                tip = (fore.length, 0.0, -fore.drop)
                parts.append(link(f"hand_{side}", WEIGHTLESS, (0.0, 0.0, 0.0), WEIGHTLESS))
                fore_name, hand = f"forearm_{side}", f"hand_{side}"
                parts.append(slider(f"lift_{side}", fore_name, hand, "0 0 1", tip, LIFT_RANGE))
        return planar("human", "trunk", "".join(parts))


ARM_JOINTS = ("shoulder", "elbow")
LIFT_RANGE = (-0.3, 0.3)
"""How far a hand follows its handle, m: one that let go hangs at its end."""
WEIGHTLESS = 1e-3
"""Mass (kg) and inertia (kg m^2) of what the engine needs to have some: it weighs 0.01 N."""


def human_body(parameters: BodyParameters, handles: tuple[Vector, ...]) -> HumanBody:
    """Return the human who holds handles, one for each holding hand, in order left, right.

    Parameters
    ----------
    parameters : BodyParameters
    handles : tuple of (x, y, z)
        In the axes of what is held, m.

    Raises
    ------
    InputError
        If a hand cannot reach its handle.
    """
    height = handles[0][2]
    arms = tuple(arm_of(parameters, side, height) for side in parameters.sides)
    if len(arms) == 2:
        middle = (handles[0][1] + handles[1][1]) / 2.0
        aside = handles[0][1] - middle - arms[0].shoulder[1]
        ahead = math.sqrt(arms[0].span(RELAXED_ELBOW) ** 2 - aside**2)
        place = (handles[0][0] - ahead, middle, 0.0)
    else:
        (arm,) = arms
        usual = arm_of(BodyParameters(), parameters.hand, USUAL_HANDLE_HEIGHT)
        _, bend = usual.angles(_at(usual, 1.0))
        x, y = _at(arm, arm.span(bend) / usual.span(bend))
        place = (handles[0][0] - x, handles[0][1] - y, 0.0)
    rest = tuple((x - place[0], y - place[1]) for x, y, _ in handles)
    pivots = tuple(
        (
            arm.fore.length - arm.fore.centre,
            0.0,
            -arm.fore.drop * (1.0 - arm.fore.centre / arm.fore.length),
        )
        for arm in arms
    )
    body = HumanBody(parameters, arms, pivots, place, rest)
    _ = body.posture  # refuses what is out of reach, before anything is built
    return body


def trunk_outline(parameters: BodyParameters) -> Outline:
    """Return what the trunk occupies; free arms give way, legs are pictures."""
    return across(trunk_breadth(parameters), trunk_depth(parameters))


def arm_outlines(human: HumanBody, handles: tuple[Vector, ...]) -> tuple[Outline, ...]:
    """Return what the arms occupy that hold given handles, from shoulder to hand, trunk axes."""
    return tuple(
        bar(arm.shoulder, rest, ARM_RADIUS, min(arm.height, handle[2]) - ARM_RADIUS)
        for arm, rest, handle in zip(human.arms, human.rest, handles, strict=True)
    )


def eye(parameters: BodyParameters) -> Vector:
    """Return where a human sees from, trunk axes, m."""
    return 0.0, 0.0, EYE_HEIGHT * parameters.height


def _at(arm: Arm, scale: float) -> tuple[float, float]:
    """Return where a single hand rests, trunk axes, m."""
    x, y = arm.shoulder
    return x + scale * BESIDE[0], y + scale * arm.side * BESIDE[1]
