"""Minimum-jerk movements, whose goal may change on the way."""

from __future__ import annotations

from ...basics.elementwise import Elementwise, Value

_SAME_GOAL = 1e-3
"""Goals that differ by less than this are the same, m."""


def minimum_jerk(share: Value) -> tuple[Value, Value]:
    """Return how far a minimum-jerk movement of length 1 has come, and its speed.

    Parameters
    ----------
    share : float, or ndarray of shape (...)
        Share s of the duration, in [0, 1].

    Returns
    -------
    (float or ndarray, float or ndarray)
        10 s^3 - 15 s^4 + 6 s^5 (Flash and Hogan 1985) and its derivative.
    """
    square, rest = share * share, 1.0 - share
    return square * share * (10.0 - share * (15.0 - 6.0 * share)), 30.0 * square * rest * rest


class Movement:
    """A movement of least jerk to a goal; a new goal bends it without a jump.

    From place x, speed v and acceleration a (each share of the duration being one unit of
    time) to rest at g = x + d, the movement of least jerk is

        x + v s + a s^2/2 + (10d - 6v - 1.5a) s^3 + (8v + 1.5a - 15d) s^4 + (6d - 3v - 0.5a) s^5,

    from rest 10 s^3 - 15 s^4 + 6 s^5 of the way (Flash and Hogan 1985); begun anew from where
    it is at each new goal, it is how a reach answers a target that jumps (Hoff and Arbib 1993).

    Parameters
    ----------
    start : float, or ndarray of shape (...)
        Where it rests at first, m.
    """

    def __init__(self, start: Value) -> None:
        self._goal = start
        self._share: Value = 1.0
        self._terms: tuple[Value, ...] = (start, 0.0, 0.0, 0.0, 0.0, 0.0)

    def place(self) -> Value:
        """Return where it is, m."""
        s, (x, v, a, c3, c4, c5) = self._share, self._terms
        if isinstance(s, float) and s == 0.0:  # it begins, for all of a batch
            return x
        return x + s * (v + s * (a + s * (c3 + s * (c4 + s * c5))))

    def speed(self) -> Value:
        """Return how fast it moves, m for each duration."""
        s, (_, v, a, c3, c4, c5) = self._share, self._terms
        if isinstance(s, float) and s == 0.0:
            return v
        return v + s * (2.0 * a + s * (3.0 * c3 + s * (4.0 * c4 + s * (5.0 * c5))))

    def aim(self, m: Elementwise, goal: Value) -> None:
        """Take another goal, m, from where it is."""
        new = abs(goal - self._goal) > _SAME_GOAL
        if not m.any(new):
            return
        s, (_, _, a, c3, c4, c5) = self._share, self._terms
        x, v = self.place(), self.speed()
        bend = a + s * (3.0 * c3 + s * (6.0 * c4 + s * (10.0 * c5)))  # half the acceleration
        d = goal - x
        begun = (
            x,
            v,
            bend,
            10.0 * d - 6.0 * v - 3.0 * bend,
            8.0 * v + 3.0 * bend - 15.0 * d,
            6.0 * d - 3.0 * v - bend,
        )
        if isinstance(s, float) and s >= 1.0:  # all at rest: who stays takes part in it
            self._terms, self._goal, self._share = begun, goal, 0.0
            return
        self._terms = tuple(m.where(new, b, t) for b, t in zip(begun, self._terms, strict=True))
        self._goal = m.where(new, goal, self._goal)
        self._share = m.where(new, 0.0, s)

    def rest(self, m: Elementwise, where: Value, place: Value) -> None:
        """Put it at rest at a place, m, where a condition holds."""
        at_rest = (place, 0.0, 0.0, 0.0, 0.0, 0.0)
        self._terms = tuple(m.where(where, r, t) for r, t in zip(at_rest, self._terms, strict=True))
        self._goal = m.where(where, place, self._goal)
        self._share = m.where(where, 1.0, self._share)

    def advance(self, m: Elementwise, share: Value) -> None:
        """Let a share of the duration go by."""
        self._share = m.minimum(self._share + share, 1.0)
