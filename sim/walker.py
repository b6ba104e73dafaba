"""Reflexes of the walking human: what the legs and the arm do on their own, in plain floats.

The human decides a hand force. Everything else that a body does while it walks with a hand on a
handle is here: keeping its place beside the base, carrying the push, holding the arm's posture.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass


@dataclass(frozen=True)
class WalkerParameters:
    """Gains of the walking human. All inferred, except where a source stands.

    Parameters
    ----------
    stiffness, damping : float
        Of the legs that keep the trunk's place beside the base, N/m and N s/m.
    yaw_stiffness, yaw_damping : float
        Of the trunk's heading against the base's, N m/rad and N m s/rad.
    delay : float
        Delay of both, s: about that of a long-latency stretch reflex.
    hand_stiffness, hand_damping : float
        Of the relaxed arm about its posture, seen at the hand, N/m and N s/m. The stiffness is
        the low end of the 50-300 N/m, the damping of the 5-30 N s/m, measured for human arms.
    """

    stiffness: float = 1500.0
    damping: float = 520.0
    yaw_stiffness: float = 40.0
    yaw_damping: float = 11.0
    delay: float = 0.05
    hand_stiffness: float = 100.0
    hand_damping: float = 10.0


@dataclass(frozen=True)
class Arm:
    """Two links in the horizontal plane.

    Parameters
    ----------
    shoulder : (x, y)
        Shoulder in trunk axes, m.
    upper, fore : float
        Length of the upper arm, and of the forearm as far as the grip, seen from above, m.
    """

    shoulder: tuple[float, float]
    upper: float
    fore: float

    def angles(self, hand: tuple[float, float]) -> tuple[float, float]:
        """Return the shoulder and elbow angle (rad) that put the hand at a place in trunk axes.

        Of the two solutions it is the one with the elbow out to the left, as a left arm bends.

        Raises
        ------
        ValueError
            If the hand cannot get there.
        """
        x, y = hand[0] - self.shoulder[0], hand[1] - self.shoulder[1]
        reach = (x * x + y * y - self.upper**2 - self.fore**2) / (2.0 * self.upper * self.fore)
        if not -1.0 < reach < 1.0:
            raise ValueError(
                f"a hand at {hand} m is out of reach of an arm of {self.upper} + {self.fore} m "
                f"at {self.shoulder} m"
            )
        elbow = -math.acos(reach)
        bend = math.atan2(self.fore * math.sin(elbow), self.upper + self.fore * math.cos(elbow))
        return math.atan2(y, x) - bend, elbow


class Walker:
    """Joint forces of the human for one physics step.

    Legs: a delayed spring and damper towards the place beside the base, plus the force that
    turns the walking body with the base (m omega x v), plus the reaction to the intended push,
    so that a steady push does not move the trunk. Arm: J^T (intended force + posture spring).

    Parameters
    ----------
    parameters : WalkerParameters
    arm : Arm
    place : (x, y, theta)
        Where the trunk walks, base axes: m, m, rad.
    handle : (x, y)
        Handle in base axes, m.
    mass : float
        Of the whole human, kg.
    step : float
        Physics step in s.
    """

    def __init__(
        self,
        parameters: WalkerParameters,
        arm: Arm,
        place: tuple[float, float, float],
        handle: tuple[float, float],
        mass: float,
        step: float,
    ) -> None:
        self._parameters = parameters
        self._arm = arm
        self._place = place
        self._mass = mass
        cos, sin = math.cos(place[2]), math.sin(place[2])
        x, y = handle[0] - place[0], handle[1] - place[1]
        self._rest = (cos * x + sin * y, cos * y - sin * x)
        self._late = round(parameters.delay / step)
        self.posture = arm.angles(self._rest)
        """Shoulder and elbow angle at which the arm rests, rad."""
        self.reset()

    def reset(self) -> None:
        """Forget the reflexes under way."""
        self._legs = deque([(0.0, 0.0, 0.0)] * self._late)

    def forces(
        self,
        base: tuple[float, ...],
        human: tuple[float, ...],
        cos: float,
        sin: float,
        push: tuple[float, float],
    ) -> tuple[float, float, float, float, float]:
        """Return the forces on the joints x, y, yaw, shoulder and elbow: N, N, N m, N m, N m.

        Parameters
        ----------
        base : (x, y, yaw, vx, vy, rate)
            State of the base, world axes: m, rad, m/s, rad/s.
        human : (x, y, yaw, shoulder, elbow, and their five rates)
            State of the human's joints.
        cos, sin : float
            Of the base's yaw.
        push : (fx, fy)
            Intended force of the hand on the base, base axes, N.
        """
        p = self._parameters
        base_x, base_y, base_yaw, base_vx, base_vy, base_rate = base
        x, y, yaw, shoulder, elbow, vx, vy, rate, shoulder_rate, elbow_rate = human

        # Legs, in base axes: place and velocity relative to the base.
        dx, dy = x - base_x, y - base_y
        place_x, place_y = cos * dx + sin * dy, cos * dy - sin * dx
        own_vx, own_vy = cos * vx + sin * vy, cos * vy - sin * vx
        slip_x = own_vx - cos * base_vx - sin * base_vy + base_rate * place_y
        slip_y = own_vy - cos * base_vy + sin * base_vx - base_rate * place_x
        turn = self._mass * base_rate
        target_x, target_y, target_yaw = self._place
        lean = yaw - base_yaw
        legs = self._legs
        legs.append(
            (
                p.stiffness * (target_x - place_x) - p.damping * slip_x - turn * own_vy,
                p.stiffness * (target_y - place_y) - p.damping * slip_y + turn * own_vx,
                p.yaw_stiffness * (target_yaw - lean) - p.yaw_damping * (rate - base_rate),
            )
        )
        push_x, push_y = push
        legs_x, legs_y, legs_yaw = legs.popleft()
        legs_x += push_x
        legs_y += push_y

        # Arm, in trunk axes.
        upper, fore = self._arm.upper, self._arm.fore
        arm_x, arm_y = upper * math.cos(shoulder), upper * math.sin(shoulder)
        bent = shoulder + elbow
        fore_x, fore_y = fore * math.cos(bent), fore * math.sin(bent)
        bent_rate = shoulder_rate + elbow_rate
        hand_x = self._arm.shoulder[0] + arm_x + fore_x
        hand_y = self._arm.shoulder[1] + arm_y + fore_y
        lean_cos, lean_sin = math.cos(lean), math.sin(lean)
        own_x = lean_cos * push_x + lean_sin * push_y
        own_y = lean_cos * push_y - lean_sin * push_x
        legs_yaw += hand_x * own_y - hand_y * own_x
        k, b = p.hand_stiffness, p.hand_damping
        own_x += k * (self._rest[0] - hand_x) + b * (arm_y * shoulder_rate + fore_y * bent_rate)
        own_y += k * (self._rest[1] - hand_y) - b * (arm_x * shoulder_rate + fore_x * bent_rate)
        at_elbow = fore_x * own_y - fore_y * own_x
        at_shoulder = arm_x * own_y - arm_y * own_x + at_elbow
        return (
            cos * legs_x - sin * legs_y,
            sin * legs_x + cos * legs_y,
            legs_yaw,
            at_shoulder,
            at_elbow,
        )
