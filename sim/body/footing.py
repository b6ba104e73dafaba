"""What shoes hold on the floor: the most that legs push, and when the footing is lost."""

from __future__ import annotations

import math

from ..basics.frames import GRAVITY

TRACTION = 0.5
"""Coefficient of friction of shoes on a dry floor: what a safe walkway has at least, the guideline
of OSHA as quoted by Fino and Lockhart (2014, J Biomech 47:1395, 10.1016/j.jbiomech.2014.01.032),
who find that walking around a corner asks for 0.38 (slow) to 0.54 (fast)."""
ON_LOST_FOOTING = ("end", "mark")
LOST_SPEED = 0.5
"""Speed that the floor fails to give at which the footing is lost, m/s: of feet that slide faster,
people fall (Strandberg and Lanshammar 1981, J Occup Accidents 3:153, as quoted by Grönqvist and
others 2001, Ergonomics 44:1167). They measured heels; that it holds for the whole body is
inferred."""


class Footing:
    """Feet on a floor, by Coulomb's law: |F| <= mu m g.

    Legs that are asked for more slide, with that force in the direction asked for. The speed that
    the body then lacks is added up, s = max(0, s + (|F_asked|/m - mu g) dt): what the floor has to
    spare wins it back, so that no peak of a step does harm. At `LOST_SPEED` the footing is lost.
    The feet bear the body's own weight alone.

    Parameters
    ----------
    traction : float
        Coefficient of friction, sticking and sliding alike.
    mass : float
        Of the body, kg.
    step : float
        Time between updates, s.
    ends : bool
        Whether lost footing ends the episode.
    """

    def __init__(self, traction: float, mass: float, step: float, ends: bool = True) -> None:
        self.most = traction * mass * GRAVITY
        """Largest horizontal force, N."""
        self._square = self.most * self.most
        self._ends = ends
        self._lacks = step / mass
        self.reset()

    def reset(self) -> None:
        """Stand firm."""
        self.held = True
        """Whether it was never lost since."""
        self._short = 0.0

    @property
    def over(self) -> bool:
        """Whether the episode is over, for the footing is lost."""
        return self._ends and not self.held

    def bear(self, x: float, y: float) -> tuple[float, float]:
        """Return what the floor gives of a horizontal force asked of the legs, N, for a step."""
        asked = x * x + y * y
        if not (asked > self._square or self._short):
            return x, y
        size = math.sqrt(asked)
        self._short = max(0.0, self._short + (size - self.most) * self._lacks)
        if size <= self.most:
            return x, y
        if self._short > LOST_SPEED:
            self.held = False
        share = self.most / size
        return share * x, share * y

    def save(self) -> tuple[bool, float]:
        """Return what `restore` takes."""
        return self.held, self._short

    def restore(self, saved: tuple[bool, float]) -> None:
        """Go on from a saved state."""
        self.held, self._short = saved
