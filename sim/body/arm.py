"""A two-link arm seen from above: reach, Jacobian, and the mass that a moving shoulder feels."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..basics.errors import InputError
from ..basics.motion import Array
from .anthropometry import (
    HALF_SHOULDERS,
    SHOULDER_HEIGHT,
    BodyParameters,
    Segment,
    forearm_with_hand,
    segment,
)

FORE_SLOPE = 0.30
"""Sine of the angle at which a relaxed forearm on a handle slants down (inferred)."""
STEEPEST = 0.90
"""Sine of the steepest slant of either link: steeper ones leave no lever seen from above
(inferred)."""
STOOP = 0.05
"""How far a shoulder comes down, by knees and a lean, to a handle that is too low for a straight
back, share of the height (inferred): so 2.2 m still carry at 0.95 m."""
SHOULDER_FREE, ELBOW_FREE = (-0.80, 2.70), (-2.55, -0.35)
"""Where a left arm's joints move freely in the horizontal plane, rad: the upper arm's azimuth from
straight ahead, outwards positive, and the angle from it to the forearm's. Inferred: adduction
across the chest, extension behind the trunk with the upper arm hanging, and the elbow's flexion of
about 145 degrees (American Academy of Orthopaedic Surgeons 1965). That flexion is of level links:
seen from above, slanted ones fold further while the elbow itself is less bent."""
SHOULDER_RANGE, ELBOW_RANGE = (-1.05, 2.95), (-2.80, -0.02)
"""Where the engine stops them, rad. In between, soft tissue resists (`end_torque`)."""
END_STIFFNESS = 1500.0
"""Elastic torque at the end of a joint's range, for each kg m^2 of the forearm about the elbow and
rad^2 beyond the free range: 0.25 rad take 6 N m in an adult of 70 kg. That such torques are passive
and rise more than in proportion is known (double exponentials in the lower limbs: Riener and Edrich
1999, J Biomech 32:539); size and square are inferred, far inside of what a step can carry
(`cowalk.sim.pair.stability`)."""
END_DAMPING = 0.015
"""Excess that counts as much as a rad/s of going further, s (inferred): damping and stiffness stay
in proportion, half of this, so that holding a torque for a few steps of 1/240 s adds no energy."""


def end_torque(beyond: float, rate: float, stiffness: float) -> float:
    """Return the torque that brings a joint back into its free range, N m.

    T = -k d (|d| + c d'), d being the excess: it starts softly, and never pulls a joint that comes
    back (as the contact law of Hunt and Crossley 1975, J Appl Mech 42:440, whose damping also
    begins at zero).

    Parameters
    ----------
    beyond : float
        How far the joint is out of its free range, rad; negative below it.
    rate : float
        Of the joint, rad/s.
    stiffness : float
        k, N m/rad^2.
    """
    further = rate if beyond > 0.0 else -rate
    return -stiffness * beyond * max(0.0, abs(beyond) + END_DAMPING * further)


ROUNDING = 1e-9
"""m."""


class Link(NamedTuple):
    """A slanted link: what of it is seen from above, and how far its end lies below its start.

    Attributes
    ----------
    mass : float
        kg.
    length, centre : float
        Of the link, and of its centre of mass from its start, both seen from above, m.
    drop : float
        m.
    inertia : float
        About the vertical through its centre of mass, kg m^2.
    """

    mass: float
    length: float
    centre: float
    drop: float
    inertia: float


def slanted(segment: Segment, drop: float) -> Link:
    """Return a slender segment that slants down by ``drop`` (m) over its length."""
    cos = math.sqrt(1.0 - (drop / segment.length) ** 2)
    return Link(
        segment.mass,
        cos * segment.length,
        cos * segment.centre,
        drop,
        cos * cos * segment.inertia,
    )


def shoulder_height(body: BodyParameters, grip_height: float) -> float:
    """Return how high a shoulder is with the grip at a height, m: upright if that reaches."""
    upright = SHOULDER_HEIGHT * body.height
    reach = STEEPEST * (segment(body, "upper_arm").length + forearm_with_hand(body).length)
    return min(upright, max(grip_height + reach, upright - STOOP * body.height))


def links(body: BodyParameters, grip_height: float) -> tuple[Link, Link]:
    """Return upper arm, and forearm with hand, so slanted that the grip is at a height (m).

    The forearm slants a little and the upper arm makes up the rest, as far as it can.

    Raises
    ------
    InputError
        If no slant reaches the height.
    """
    upper, fore = segment(body, "upper_arm"), forearm_with_hand(body)
    shoulders = shoulder_height(body, grip_height)
    drop = shoulders - grip_height
    steep = STEEPEST * upper.length
    upper_drop = min(max(drop - FORE_SLOPE * fore.length, -steep), steep)
    if abs(drop - upper_drop) > STEEPEST * fore.length + ROUNDING:
        raise InputError(
            f"a human of {body.height} m cannot hold a handle at {grip_height:.2f} m: their "
            f"shoulder is at {shoulders:.2f} m"
        )
    return slanted(upper, upper_drop), slanted(fore, drop - upper_drop)


@dataclass(frozen=True)
class Arm:
    """Two links in the horizontal plane, in trunk axes (x forward, y left).

    Parameters
    ----------
    shoulder : (x, y)
        m.
    upper, fore : Link
    side : float
        +1 left, -1 right: where the elbow points, and which way the joints' ranges lie.
    height : float
        Of the shoulder, m.
    """

    shoulder: tuple[float, float]
    upper: Link
    fore: Link
    side: float = 1.0
    height: float = math.nan

    def angles(self, hand: tuple[float, float]) -> tuple[float, float]:
        """Return the shoulder and elbow angle (rad) that put the hand at a place in trunk axes.

        Of the two solutions it is the one with the elbow out to the arm's own side.

        Raises
        ------
        InputError
            If the hand cannot get there within the joints' free ranges.
        """
        upper, fore = self.upper.length, self.fore.length
        x, y = hand[0] - self.shoulder[0], self.side * (hand[1] - self.shoulder[1])
        reach = (x * x + y * y - upper**2 - fore**2) / (2.0 * upper * fore)
        elbow = -math.acos(reach) if -1.0 < reach < 1.0 else 1.0
        bend = math.atan2(fore * math.sin(elbow), upper + fore * math.cos(elbow))
        shoulder = math.remainder(math.atan2(y, x) - bend, math.tau)
        lowest, highest = ELBOW_FREE
        if not (lowest < elbow < highest and SHOULDER_FREE[0] < shoulder < SHOULDER_FREE[1]):
            raise InputError(
                f"a hand at ({hand[0]:.2f}, {hand[1]:.2f}) m is out of reach of an arm of "
                f"{upper:.2f} + {fore:.2f} m (seen from above) at "
                f"({self.shoulder[0]:.2f}, {self.shoulder[1]:.2f}) m"
            )
        return self.side * shoulder, self.side * elbow

    @property
    def end_stiffness(self) -> float:
        """Of `end_torque`, N m/rad^2."""
        fore = self.fore
        return END_STIFFNESS * (fore.inertia + fore.mass * fore.centre**2)

    @property
    def free(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Free range of shoulder and elbow, rad, as this arm's side has it."""
        if self.side > 0.0:
            return SHOULDER_FREE, ELBOW_FREE
        return (-SHOULDER_FREE[1], -SHOULDER_FREE[0]), (-ELBOW_FREE[1], -ELBOW_FREE[0])

    def span(self, elbow: float) -> float:
        """Return the distance from shoulder to hand, seen from above, at an elbow angle, m."""
        upper, fore = self.upper.length, self.fore.length
        return math.sqrt(upper**2 + fore**2 + 2.0 * upper * fore * math.cos(elbow))

    def jacobian(self, shoulder: float, elbow: float) -> Array:
        """Return d(hand)/d(angles), shape (2, 2), m."""
        return self._jacobian(shoulder, elbow, 1, self.fore.length)

    def _jacobian(self, shoulder: float, elbow: float, link: int, along: float) -> Array:
        """Return d(point)/d(angles) of a point ``along`` (m) link 0 or 1."""
        first = self.upper.length if link else along
        column = first * np.array([-math.sin(shoulder), math.cos(shoulder)])
        if not link:
            return np.stack((column, np.zeros(2)), axis=-1)
        bent = shoulder + elbow
        beyond = along * np.array([-math.sin(bent), math.cos(bent)])
        return np.stack((column + beyond, beyond), axis=-1)

    def apparent_mass(self, shoulder: float, elbow: float) -> Array:
        """Return the mass, shape (2, 2), kg, that the held hand passes on from a moving shoulder.

        With the hand held and the shoulder accelerating by a, the arm's inertia adds
        Lambda a to the force of the hand, Lambda = J^-T (M J^-1 - sum_i m_i J_i^T), where M is
        the joint-space mass matrix and J_i the Jacobian of the centre of link i.
        """
        mass, carried = self.inertia(shoulder, elbow)
        inverse = np.linalg.inv(self.jacobian(shoulder, elbow))
        return np.asarray(inverse.T @ (mass @ inverse - carried))

    def inertia(self, shoulder: float, elbow: float) -> tuple[Array, Array]:
        """Return M, kg m^2, and sum_i m_i J_i^T, kg m, each of shape (2, 2)."""
        mass = np.zeros((2, 2))
        carried = np.zeros((2, 2))
        for index, link in enumerate((self.upper, self.fore)):
            centre = self._jacobian(shoulder, elbow, index, link.centre)
            turns = np.array([1.0, float(index)])
            mass += link.mass * centre.T @ centre + link.inertia * np.outer(turns, turns)
            carried += link.mass * centre.T
        return mass, carried


def arm_of(body: BodyParameters, side: str, grip_height: float) -> Arm:
    """Return an arm of a body, its grip at a height (m)."""
    sign = 1.0 if side == "left" else -1.0
    # The joint's centre lies a little outside and below the acromion's mark (inferred).
    shoulder = (0.0, sign * SHOULDER_BREADTH * body.height)
    height = shoulder_height(body, grip_height)
    return Arm(shoulder, *links(body, grip_height), sign, height)


SHOULDER_BREADTH = 0.2 / 1.75
"""Where the shoulder joint is to the side, share of the height: `HALF_SHOULDERS` less the part
of it that is muscle (inferred)."""
assert SHOULDER_BREADTH < HALF_SHOULDERS
