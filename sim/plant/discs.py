"""Two discs, for whoever knows nothing more of the bodies."""

from __future__ import annotations

from ..body.anthropometry import EYE_HEIGHT, BodyParameters
from ..robot.shipped import BASE_RADIUS, CAMERA_PLACE
from ..world.outline import Bodies, disc

HUMAN_RADIUS = 0.22
"""Radius of the disc that stands for a human's trunk, m (half of a shoulder breadth of 0.44 m)."""

PLAIN_BODIES = Bodies(
    {"base": disc(BASE_RADIUS), "human": disc(HUMAN_RADIUS)},
    {"automation": CAMERA_PLACE, "human": (0.0, 0.0, EYE_HEIGHT * BodyParameters.height)},
)
"""Two discs, for whoever knows nothing more of the bodies."""

HUMAN_PLACE = (-0.10, -0.65, 0.0)
"""Pose at which the human walks beside the base, in base axes: m, m, rad."""
