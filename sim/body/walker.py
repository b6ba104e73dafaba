"""Reflexes of the walking human: what the legs and the arm do on their own, in plain floats.

The human decides a hand force. Everything else that a body does while it walks with a hand on a
handle is here: keeping its place beside the base, carrying the push, holding the arm's posture.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import Any, NamedTuple

from ..basics.validators import Range, require_choices, require_ranges
from .anthropometry import BodyParameters, yaw_inertia
from .arm import end_torque
from .footing import ON_LOST_FOOTING, TRACTION, Footing
from .gait import Gait
from .human_body import HumanBody

RANGES: dict[str, Range] = {
    "stiffness": (0.0, 1e9, "N/m"),
    "damping": (0.0, 1e9, "N s/m"),
    "yaw_stiffness": (0.0, 1e9, "N m/rad"),
    "yaw_damping": (0.0, 1e9, "N m s/rad"),
    "delay": (0.0, 0.3, "s"),
    "hand_stiffness": (0.0, 1e9, "N/m"),
    "hand_damping": (0.0, 1e9, "N s/m"),
    "traction": (0.01, 10.0, ""),
}


@dataclass(frozen=True)
class WalkerParameters:
    """Gains of the walking human. All inferred, except where a source stands.

    Parameters
    ----------
    stiffness, damping : float
        Of the legs that keep the trunk's place beside the base, N/m and N s/m. They are those of
        a person of 1.75 m and 70 kg; anybody else's go with their mass.
    yaw_stiffness, yaw_damping : float
        Of the trunk's heading against the base's, N m/rad and N m s/rad; likewise, with the
        moment of inertia about the vertical. So everybody moves alike (`legs_of`).
    delay : float
        Delay of both, s: about that of a long-latency stretch reflex.
    hand_stiffness, hand_damping : float
        Of the arm about its posture, seen at the hand, N/m and N s/m, from the lower part of the
        project's ranges of 50-300 N/m and 5-30 N s/m. Two arms share them. Such numbers come from
        small displacements of a held hand (Mussa-Ivaldi, Hogan and Bizzi 1985, J Neurosci
        5:2732; Dolan, Friedman and Nagurka 1993, IEEE Trans SMC 23:698); the ends of the ranges
        could not be looked up there, so they count as typical.
    traction : float
        Coefficient of friction of shoes on the floor: legs push no harder than that share of the
        body's weight (`cowalk.sim.body.footing`).
    on_lost_footing : {"end", "mark"}
        What lost footing does: end the episode, or mark it and let the body slide on.

    Raises
    ------
    InputError
        If one is outside of `RANGES`, or none of the words. What is too stiff to be simulated is
        refused where the bodies are known (`cowalk.sim.pair.gains`).
    """

    stiffness: float = 1500.0
    damping: float = 520.0
    yaw_stiffness: float = 40.0
    yaw_damping: float = 11.0
    delay: float = 0.05
    hand_stiffness: float = 100.0
    hand_damping: float = 10.0
    traction: float = TRACTION
    on_lost_footing: str = "end"

    def __post_init__(self) -> None:
        require_ranges(self, RANGES)
        require_choices(self, {"on_lost_footing": ON_LOST_FOOTING})


class Legs(NamedTuple):
    """What keeps the trunk's place and heading: N/m, N s/m, N m/rad, N m s/rad."""

    stiffness: float
    damping: float
    yaw_stiffness: float
    yaw_damping: float


def legs_of(parameters: WalkerParameters, body: BodyParameters) -> Legs:
    """Return the legs' gains of a body: with its mass and moment of inertia (inferred).

    The delay is everybody's, so gains that did not shrink with the body would swing a child up.
    """
    usual = BodyParameters()
    weight = body.mass / usual.mass
    turn = yaw_inertia(body) / yaw_inertia(usual)
    p = parameters
    return Legs(
        weight * p.stiffness, weight * p.damping, turn * p.yaw_stiffness, turn * p.yaw_damping
    )


class Walker:
    """Joint forces of the human for one physics step.

    Legs: a delayed spring and damper towards the place beside the base, plus the force that
    turns the walking body with the base (m omega x v), plus the reaction to the intended push,
    so that a steady push does not move the trunk, plus what the sway of the gait takes (m a).
    All of it is no more than what the shoes hold (`cowalk.sim.body.footing`).
    Arms: J^T (intended force + posture spring), and soft tissue at the ends of a joint's range
    (`cowalk.sim.body.arm.end_torque`).

    Parameters
    ----------
    parameters : WalkerParameters
    body : HumanBody
    place : (x, y, theta)
        Where the trunk walks, base axes: m, m, rad.
    gait : Gait
    mass : float
        Of the whole human, kg.
    step : float
        Time between updates, s.
    """

    def __init__(
        self,
        parameters: WalkerParameters,
        body: HumanBody,
        place: tuple[float, float, float],
        gait: Gait,
        mass: float,
        step: float,
    ) -> None:
        self._gains = legs_of(parameters, body.parameters)
        self._arms = tuple(
            (
                3 + 2 * index,
                *arm.shoulder,
                arm.upper.length,
                arm.fore.length,
                *rest,
                *arm.free[0],
                *arm.free[1],
                arm.end_stiffness,
            )
            for index, (arm, rest) in enumerate(zip(body.arms, body.rest, strict=True))
        )
        self._joints = 3 + 2 * len(self._arms)
        share = 1.0 / len(self._arms)
        self._share = share
        self._hand = (share * parameters.hand_stiffness, share * parameters.hand_damping)
        self._place = place
        self._mass = mass
        self._late = round(parameters.delay / step)
        self.gait = gait
        ends = parameters.on_lost_footing == "end"
        self.footing = Footing(parameters.traction, mass, step, ends)
        self._legs: deque[tuple[float, float, float]] = deque()

    def reset(self, vx: float = 0.0, vy: float = 0.0, rate: float = 0.0) -> None:
        """Forget the reflexes under way but those of a steady walk.

        Parameters
        ----------
        vx, vy, rate : float
            Velocity of the trunk, base axes, m/s, and of the base's turning, rad/s.
        """
        turn = self._mass * rate
        self._legs = deque([(-turn * vy, turn * vx, 0.0)] * self._late)
        self.footing.reset()

    def save(self) -> tuple[Any, ...]:
        """Return what `restore` takes."""
        return tuple(self._legs), self.gait.save(), self.footing.save()

    def restore(self, saved: tuple[Any, ...]) -> None:
        """Go on from a saved state."""
        legs, gait, footing = saved
        self._legs = deque(legs)
        self.gait.restore(gait)
        self.footing.restore(footing)

    def forces(
        self,
        base: tuple[float, ...],
        human: tuple[float, ...],
        cos: float,
        sin: float,
        push: tuple[float, float],
    ) -> list[float]:
        """Return the forces on the joints x, y, yaw, and shoulder and elbow of each arm.

        Parameters
        ----------
        base : (x, y, yaw, vx, vy, rate)
            State of the base, world axes: m, rad, m/s, rad/s.
        human : (x, y, yaw, shoulder, elbow, ..., and their rates)
            State of the human's joints.
        cos, sin : float
            Of the base's yaw.
        push : (fx, fy)
            Intended force of the hands on the base, base axes, N.

        Returns
        -------
        list of float
            N, N, N m, N m, ...
        """
        p, joints = self._gains, self._joints
        base_x, base_y, base_yaw, base_vx, base_vy, base_rate = base
        vx, vy, rate = human[joints], human[joints + 1], human[joints + 2]

        # Legs, in base axes: place and velocity relative to the base.
        dx, dy = human[0] - base_x, human[1] - base_y
        place_x, place_y = cos * dx + sin * dy, cos * dy - sin * dx
        own_vx, own_vy = cos * vx + sin * vy, cos * vy - sin * vx
        slip_x = own_vx - cos * base_vx - sin * base_vy + base_rate * place_y
        slip_y = own_vy - cos * base_vy + sin * base_vx - base_rate * place_x
        turn = self._mass * base_rate
        target_x, target_y, target_yaw = self._place
        lean = human[2] - base_yaw
        legs_x = legs_y = 0.0
        if self.gait.enabled:
            # The pace is that of the place beside the base: the trunk's own has the sway in it.
            sway_x, sway_y, sway_vx, sway_vy, ax, ay = self.gait.update(own_vx - slip_x)
            target_x += sway_x
            target_y += sway_y
            slip_x -= sway_vx
            slip_y -= sway_vy
            legs_x, legs_y = self._mass * ax, self._mass * ay
        legs = self._legs
        legs.append(
            (
                p.stiffness * (target_x - place_x) - p.damping * slip_x - turn * own_vy,
                p.stiffness * (target_y - place_y) - p.damping * slip_y + turn * own_vx,
                p.yaw_stiffness * (target_yaw - lean) - p.yaw_damping * (rate - base_rate),
            )
        )
        push_x, push_y = push
        late_x, late_y, legs_yaw = legs.popleft()
        legs_x, legs_y = self.footing.bear(legs_x + late_x + push_x, legs_y + late_y + push_y)

        # Arms, in trunk axes.
        lean_cos, lean_sin = math.cos(lean), math.sin(lean)
        share, (k, b) = self._share, self._hand
        pushed_x = share * (lean_cos * push_x + lean_sin * push_y)
        pushed_y = share * (lean_cos * push_y - lean_sin * push_x)
        forces = [cos * legs_x - sin * legs_y, sin * legs_x + cos * legs_y, 0.0]
        for (
            joint,
            shoulder_x,
            shoulder_y,
            upper,
            fore,
            rest_x,
            rest_y,
            shoulder_low,
            shoulder_high,
            elbow_low,
            elbow_high,
            end_stiffness,
        ) in self._arms:
            shoulder, elbow = human[joint], human[joint + 1]
            bent = shoulder + elbow
            shoulder_rate = human[joints + joint]
            elbow_rate = human[joints + joint + 1]
            bent_rate = shoulder_rate + elbow_rate
            arm_x, arm_y = upper * math.cos(shoulder), upper * math.sin(shoulder)
            fore_x, fore_y = fore * math.cos(bent), fore * math.sin(bent)
            hand_x, hand_y = shoulder_x + arm_x + fore_x, shoulder_y + arm_y + fore_y
            legs_yaw += hand_x * pushed_y - hand_y * pushed_x
            own_x = (
                pushed_x + k * (rest_x - hand_x) + b * (arm_y * shoulder_rate + fore_y * bent_rate)
            )
            own_y = (
                pushed_y + k * (rest_y - hand_y) - b * (arm_x * shoulder_rate + fore_x * bent_rate)
            )
            at_elbow = fore_x * own_y - fore_y * own_x
            at_shoulder = arm_x * own_y - arm_y * own_x + at_elbow
            if not shoulder_low < shoulder < shoulder_high:
                end = shoulder_high if shoulder > shoulder_low else shoulder_low
                at_shoulder += end_torque(shoulder - end, shoulder_rate, end_stiffness)
            if not elbow_low < elbow < elbow_high:
                end = elbow_high if elbow > elbow_low else elbow_low
                at_elbow += end_torque(elbow - end, elbow_rate, end_stiffness)
            forces.append(at_shoulder)
            forces.append(at_elbow)
        forces[2] = legs_yaw
        return forces
