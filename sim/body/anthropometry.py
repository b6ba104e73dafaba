"""Segment masses, lengths and inertias of a human of any height and mass. Pure.

D. A. Winter, Biomechanics and Motor Control of Human Movement, 4th ed., Wiley 2009: table 4.1
(masses, centres, radii of gyration; after Dempster 1955) and figure 4.1 (lengths; after Drillis
and Contini 1966).

Table 4.1 was compared, number by number, with two transcriptions: BMClab/BMC,
data/BSP_DempsterWinter.txt, and University of Rhode Island, BME 207, anthropometric data, table 1.
De Leva (1996, J Biomech 29:1223) has heavier thighs (14.2 %) and a lighter trunk (43.5 %) for men;
for arm and hand, which are what the handle feels, the two agree within 0.2 % of the body's mass.
Of figure 4.1, only the lengths of foot and thigh and the heights of shoulder, hip and ankle were
found transcribed elsewhere; the others stand as they are commonly quoted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from ..basics.validators import Range, require_choices, require_ranges


class SegmentRatios(NamedTuple):
    """A segment as shares: of the body's mass, of its height, and of the segment's length."""

    mass: float
    length: float
    centre: float
    """From the proximal end."""
    gyration: float
    """Radius of gyration about the centre, across the segment."""


WINTER = {
    "hand": SegmentRatios(0.006, 0.108, 0.506, 0.297),
    "forearm": SegmentRatios(0.016, 0.146, 0.430, 0.303),
    "upper_arm": SegmentRatios(0.028, 0.186, 0.436, 0.322),
    "foot": SegmentRatios(0.0145, 0.152, 0.50, 0.475),
    "shank": SegmentRatios(0.0465, 0.246, 0.433, 0.302),
    "thigh": SegmentRatios(0.100, 0.245, 0.433, 0.323),
}
"""Limb segments, one side."""
HEAD_MASS, TRUNK_MASS = 0.081, 0.497
"""Head with neck, and thorax with abdomen and pelvis; shares of the body's mass."""
SHOULDER_HEIGHT, HIP_HEIGHT, EYE_HEIGHT, ANKLE_HEIGHT = 0.818, 0.530, 0.936, 0.039
"""Shares of the body's height."""
HALF_SHOULDERS, HALF_HIPS = 0.129, 0.0955
"""Half the distance of the acromions, and half the breadth of the hips; shares of the height."""
GRIP = 0.506
"""Where the hand closes around a handle: at its centre of mass, share of the hand's length."""
TRUNK_DEPTH = 0.53
"""Depth of the trunk as a share of its breadth. Inferred: 0.24 m of 0.45 m."""
YAW_GYRATION = 0.0748
"""Radius of gyration of a standing body about the vertical, share of the height. Inferred: it
makes 1.2 kg m^2 at 70 kg and 1.75 m."""


HANDS = ("left", "right", "both")
RANGES: dict[str, Range] = {"height": (1.2, 2.2, "m"), "mass": (20.0, 200.0, "kg")}
"""Of adults and children who walk with a robot (inferred)."""


@dataclass(frozen=True)
class BodyParameters:
    """A human.

    Parameters
    ----------
    height : float
        m.
    mass : float
        kg.
    hand : {"left", "right", "both"}
        What holds on. With the left hand the human walks to the right of what they hold, with
        the right hand to the left, with both hands behind it.

    Raises
    ------
    InputError
        If height or mass is no adult's or child's, or the hand is unknown.
    """

    height: float = 1.75
    mass: float = 70.0
    hand: str = "left"

    def __post_init__(self) -> None:
        require_ranges(self, RANGES)
        require_choices(self, {"hand": HANDS})

    @property
    def sides(self) -> tuple[str, ...]:
        """The arms that hold on."""
        return ("left", "right") if self.hand == "both" else (self.hand,)


class Segment(NamedTuple):
    """A segment in numbers: kg, m, m from its proximal end, and kg m^2 about its centre."""

    mass: float
    length: float
    centre: float
    inertia: float


def segment(body: BodyParameters, name: str) -> Segment:
    """Return a limb segment of a body, by its name in `WINTER`."""
    ratios = WINTER[name]
    mass, length = ratios.mass * body.mass, ratios.length * body.height
    return Segment(mass, length, ratios.centre * length, mass * (ratios.gyration * length) ** 2)


def forearm_with_hand(body: BodyParameters) -> Segment:
    """Return forearm and fist as one rigid segment that ends where the hand grips."""
    fore, hand = segment(body, "forearm"), segment(body, "hand")
    length = fore.length + GRIP * hand.length
    mass = fore.mass + hand.mass
    hand_centre = fore.length + hand.centre
    centre = (fore.mass * fore.centre + hand.mass * hand_centre) / mass
    inertia = (
        fore.inertia
        + hand.inertia
        + fore.mass * (fore.centre - centre) ** 2
        + hand.mass * (hand_centre - centre) ** 2
    )
    return Segment(mass, length, centre, inertia)


def girth(body: BodyParameters) -> float:
    """Return how much wider a body is than one of its height that is built like the default.

    Volume goes with mass, so a cross-section's sides go with the root of mass over height
    (inferred: trunk breadths are published for average builds).
    """
    usual = BodyParameters()
    return math.sqrt((body.mass / body.height**3) / (usual.mass / usual.height**3))


def trunk_breadth(body: BodyParameters) -> float:
    """Return the breadth of the trunk at the shoulders, m: 0.45 m by default."""
    return 2.0 * HALF_SHOULDERS * body.height * girth(body)


def trunk_depth(body: BodyParameters) -> float:
    """Return the depth of the trunk, m: 0.24 m by default."""
    return TRUNK_DEPTH * trunk_breadth(body)


def yaw_inertia(body: BodyParameters) -> float:
    """Return the moment of inertia of the standing body about the vertical, kg m^2."""
    return body.mass * (YAW_GYRATION * body.height) ** 2
