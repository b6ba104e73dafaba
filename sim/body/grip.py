"""What a hand does to what it holds: rigid or yielding, slipping, letting go. Pure."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..basics.lists import require_entries
from ..basics.validators import Range, require, require_choices, require_effect, require_ranges

GRIPS = ("rigid", "compliant")
ON_LOSS = ("end", "stop")
RANGES: dict[str, Range] = {
    "slip_force": (0.1, 1e4, "N"),
    "slip_length": (1e-4, 100.0, "m"),
    "release_force": (0.1, 1e4, "N"),
}
"""What a hand can do, with room to spare (inferred)."""
SPRING: Range = (0.0, 1e9, "")
"""Of stiffness and damping, SI: what is too stiff to be simulated is refused later (inferred)."""
Triple = tuple[float, float, float]


@dataclass(frozen=True)
class GripParameters:
    """A hand around a handle. All defaults inferred, except where a source stands.

    Parameters
    ----------
    kind : {"rigid", "compliant"}
        Rigid holds the hand's place and leaves the wrist free but for its own stiffness;
        compliant is a spring and damper in all six axes.
    stiffness, damping : (float, float, float)
        Of a compliant grip along handle axes x, y, z: N/m and N s/m. Bodies that stay upright and
        at their height never pull along z: that one transmits nothing.
    turn_stiffness, turn_damping : (float, float, float)
        Of wrist and grip about handle axes x, y, z: N m/rad and N m s/rad. Bodies that stay
        upright turn about z alone: the first two transmit nothing. A relaxed wrist has 0.5 to 3
        N m/rad (inferred); 0 is a free wrist, which hands over no torque.
    slip_force : float, optional
        Force beyond which a compliant grip slides along, N; None never does.
    slip_length : float
        How far it can slide before it is lost, m.
    release_force : float, optional
        Force beyond which the hand lets go, N, judged in every physics step; that of both hands
        together where both hold. None never does.
    on_loss : {"end", "stop"}
        What a lost grip does: end the episode, or let the base come to a stop.

    Raises
    ------
    InputError
        If a kind is unknown, a number is outside of `RANGES` or `SPRING`, or one is given that
        has no effect with the kind.
    """

    kind: str = "rigid"
    stiffness: Triple = (4000.0, 4000.0, 4000.0)
    damping: Triple = (40.0, 40.0, 40.0)
    turn_stiffness: Triple = (0.0, 0.0, 0.0)
    turn_damping: Triple = (0.0, 0.0, 0.0)
    slip_force: float | None = None
    slip_length: float = 0.05
    release_force: float | None = None
    on_loss: str = "end"

    def __post_init__(self) -> None:
        require_choices(self, {"kind": GRIPS, "on_loss": ON_LOSS})
        springs = ("stiffness", "damping", "turn_stiffness", "turn_damping")
        require_entries(self, springs, 3, SPRING)
        holds = self.kind == "rigid" or min(self.stiffness[:2]) > 0.0
        require(holds, "stiffness", self.stiffness, "must be above 0 along x and y")
        require_ranges(self, RANGES)
        holds = self.slip_force is None or self.kind == "compliant"
        require(holds, "slip_force", self.slip_force, "only a compliant grip can slip")
        require_effect(self, {"compliant": ("stiffness", "damping", "slip_length")})


class Bushing:
    """Spring and damper between a hand and a handle, whose anchor slides when pulled too hard.

    F = K (d - anchor) + B d', per axis of the handle, d being the hand's place less the
    handle's. Where |F| exceeds the slip force, the anchor follows so far that it does not.

    Parameters
    ----------
    parameters : GripParameters
    """

    def __init__(self, parameters: GripParameters) -> None:
        self._stiffness, self._damping = parameters.stiffness, parameters.damping
        self._slip_force = math.inf if parameters.slip_force is None else parameters.slip_force
        self._slip_length = parameters.slip_length
        self.anchor = (0.0, 0.0)
        """How far the grip has slid, handle axes, m."""

    def force(self, offset: Triple, rate: Triple) -> Triple:
        """Return the hand's force on the handle, N, handle axes.

        Parameters
        ----------
        offset, rate : (x, y, z)
            Of the hand from the handle, handle axes: m and m/s.
        """
        (kx, ky, kz), (bx, by, bz) = self._stiffness, self._damping
        anchor_x, anchor_y = self.anchor
        pull_x, pull_y = kx * (offset[0] - anchor_x), ky * (offset[1] - anchor_y)
        fx, fy = pull_x + bx * rate[0], pull_y + by * rate[1]
        force = math.hypot(fx, fy)
        if force > self._slip_force:
            share = self._slip_force / force
            fx, fy = share * fx, share * fy
            # What spring is left to give, so that force and anchor agree.
            self.anchor = (
                offset[0] - (fx - bx * rate[0]) / kx,
                offset[1] - (fy - by * rate[1]) / ky,
            )
        return fx, fy, kz * offset[2] + bz * rate[2]

    @property
    def lost(self) -> bool:
        """Whether it has slid off."""
        return math.hypot(*self.anchor) > self._slip_length
