"""The automation's own wish, and the Pareto front between it and the human's.

Cost of a motion primitive: J = w1 d^2 + w2 v^2 + w3 omega^2 (Schneider et al., arXiv
2407.17275). Where omega alone is negotiated, d is the distance of the arc's end from the
path. Where v is negotiated too, that J would reward standing still, so d is measured to the
path point that the usual pace reaches within the horizon.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from cowalk.sim.basics.motion import Array, arc_displacement, compose, unit_arc, world_to_base
from cowalk.sim.basics.situation import Situation

from .minimise import _grid, beside_least, minimise, vertex
from .settings import NegotiationSettings

_SHARES = np.linspace(0.0, 1.0, 17)
_TINY = 1e-12


class Problem(ABC):
    """What there is to negotiate at one pose.

    Parameters
    ----------
    settings : NegotiationSettings
        Horizon and weights; each may be an array of shape (...), a lane each.
    situation : Situation
    pose : ndarray, shape (..., 3)
        World pose of the base.
    """

    def __init__(self, settings: NegotiationSettings, situation: Situation, pose: Array) -> None:
        self._situation = situation
        self._pose = pose
        self._lower = np.asarray(situation.bounds.lower, dtype=float)
        self._upper = np.asarray(situation.bounds.upper, dtype=float)
        # One more axis: n primitives of the same pose.
        self._horizon = np.asarray(settings.horizon, dtype=float)[..., None]
        self._w1 = np.asarray(settings.distance_weight, dtype=float)[..., None]
        self._w2 = np.asarray(settings.speed_weight, dtype=float)[..., None]
        self._w3 = np.asarray(settings.turn_weight, dtype=float)[..., None]

    @abstractmethod
    def cost(self, twist: Array) -> Array:
        """Return J, shape (..., n), of primitives of shape (..., n, 2), m/s and rad/s."""

    @abstractmethod
    def wish(self) -> Array:
        """Return p_A*, the primitive of least cost within the bounds, shape (..., 2)."""

    @abstractmethod
    def front(self, own: Array, human: Array, gap: Array) -> tuple[Array, Array]:
        """Return points of the Pareto front between the two wishes, and what they cost.

        A point minimises share * J + (1 - share) * |(p - p_H)/p_ub|^2, both normed to lie
        between 0 at one side's wish and 1 at the other's; the shares are evenly spaced from 0
        (the human's wish) to 1 (one's own).

        Parameters
        ----------
        own, human : ndarray, shape (..., 2)
            p_A* and the estimated human wish, m/s and rad/s.
        gap : ndarray, shape (..., 1)
            J of the human's wish less J of one's own.

        Returns
        -------
        (ndarray, ndarray), shapes (..., n, 2) and (..., n)
        """


class TurnProblem(Problem):
    """Omega alone is negotiated, v is the usual pace; d is the distance from the path."""

    def cost(self, twist: Array) -> Array:
        """See `Problem.cost`."""
        end = compose(self._pose[..., None, :], arc_displacement(twist, self._horizon))
        offset = self._situation.path.relative_pose(end)[..., 1]
        return np.asarray(
            self._w1 * offset**2 + self._w2 * twist[..., 0] ** 2 + self._w3 * twist[..., 1] ** 2
        )

    def wish(self) -> Array:
        """See `Problem.wish`."""
        lanes = np.broadcast_shapes(
            self._pose.shape[:-1], self._horizon.shape[:-1], self._upper.shape[:-1]
        )
        low, high = (np.broadcast_to(b[..., 1], lanes) for b in (self._lower, self._upper))
        return self._at_pace(minimise(lambda omega: self.cost(self._at_pace(omega)), low, high))

    def front(self, own: Array, human: Array, gap: Array) -> tuple[Array, Array]:
        """See `Problem.front`; in one dimension it is the interval between the wishes."""
        points = self._at_pace(human[..., None, 1] + _SHARES * (own - human)[..., None, 1])
        return points, self.cost(points)

    def _at_pace(self, omega: Array) -> Array:
        return np.stack((np.full_like(omega, self._situation.pace), omega), axis=-1)


class TwistProblem(Problem):
    """Omega and v are negotiated; d is the distance from the path point at the usual pace.

    The arc's end is linear in v, so J is a parabola in v at every omega, and one search over
    omega is enough.
    """

    def __init__(self, settings: NegotiationSettings, situation: Situation, pose: Array) -> None:
        super().__init__(settings, situation, pose)
        station = situation.path.relative_pose(pose)[..., :1]
        goal = situation.path.point_at(station + situation.pace * self._horizon)
        ahead = world_to_base(pose[..., None, :], goal)
        self._ahead, self._left = ahead[..., 0], ahead[..., 1]
        self._reach_weight = self._w1 * self._horizon**2
        self._pull_weight = self._w1 * self._horizon
        self._rest = self._w1 * (self._ahead**2 + self._left**2)
        # Bounds of v, the range of omega, and the costs at its grid, which all searches share.
        self._slowest, self._fastest = self._lower[..., :1], self._upper[..., :1]
        self._range = self._lower[..., 1:], self._upper[..., 1:] - self._lower[..., 1:]
        self._turns = self._range[0] + self._range[1] * _grid(33)
        self._parabolas = self._parabola(self._turns)
        self._scale = self._upper**-2

    def _parabola(self, omega: Array) -> tuple[Array, Array, Array]:
        """Return (a, b, c) of J = a v^2 - 2 b v + c, each of shape (..., n)."""
        ahead, left = unit_arc(omega * self._horizon)
        square = ahead * ahead + left * left
        along = ahead * self._ahead + left * self._left
        return (
            self._reach_weight * square + self._w2,
            self._pull_weight * along,
            self._rest + self._w3 * (omega * omega),
        )

    def cost(self, twist: Array) -> Array:
        """See `Problem.cost`."""
        v = twist[..., 0]
        a, b, c = self._parabola(twist[..., 1])
        return np.asarray((a * v - 2.0 * b) * v + c)

    def wish(self) -> Array:
        """See `Problem.wish`."""
        left, width = beside_least(self._least(*self._parabolas)[1], *self._range)
        turns = left + width * _grid(17)
        omega = vertex(self._least(*self._parabola(turns))[1], left, width)[..., None]
        v, _ = self._least(*self._parabola(omega))
        return np.concatenate((v, omega), axis=-1)

    def _least(self, a: Array, b: Array, c: Array) -> tuple[Array, Array]:
        """Return the v of least cost, and that cost, of every parabola, shape (..., n)."""
        v = np.minimum(np.maximum(b / a, self._slowest), self._fastest)  # np.clip takes longer
        return v, (a * v - 2.0 * b) * v + c

    def front(self, own: Array, human: Array, gap: Array) -> tuple[Array, Array]:
        """See `Problem.front`: the best v in closed form for every share and every omega."""
        # Axes: lanes, shares, omega.
        away = (((own - human) ** 2) * self._scale).sum(axis=-1)[..., None, None]
        own_weight = _SHARES[:, None] / np.maximum(gap[..., None], _TINY)
        human_weight = (1.0 - _SHARES[:, None]) / np.maximum(away, _TINY)
        v_weight = human_weight * self._scale[..., None, None, 0]
        omega_weight = human_weight * self._scale[..., None, None, 1]
        v_human, omega_human = human[..., None, None, 0], human[..., None, None, 1]
        asked = v_weight * v_human
        slowest, fastest = self._slowest[..., None], self._fastest[..., None]

        def best(a: Array, b: Array, c: Array) -> tuple[Array, Array]:
            v = (own_weight * b + asked) / (own_weight * a + v_weight)
            v = np.minimum(np.maximum(v, slowest), fastest)
            return v, (a * v - 2.0 * b) * v + c

        v, cost = best(*(part[..., None, :] for part in self._parabolas))
        slower, turned = v - v_human, self._turns[..., None, :] - omega_human
        total = own_weight * cost + v_weight * (slower * slower) + omega_weight * (turned * turned)
        left, width = self._range
        omega = vertex(total, left[..., None], width[..., None])
        v, cost = best(*(part[..., None] for part in self._parabola(omega)))
        return np.stack((v[..., 0], omega), axis=-1), cost[..., 0]


PROBLEMS: dict[str, type[Problem]] = {"omega": TurnProblem, "both": TwistProblem}
"""The problem that each choice of `NegotiationSettings.dimensions` poses."""
