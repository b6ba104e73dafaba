"""The automation's own wish, and the Pareto front between it and the human's.

Cost of a motion primitive: J = w1 d^2 + w2 v^2 + w3 omega^2 (Schneider et al., arXiv
2407.17275). Where omega alone is negotiated, d is the distance of the arc's end from the
path. Where v is negotiated too, that J would reward standing still, so d is measured to the
path point that the usual pace reaches within the horizon.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cache

import numpy as np

from cowalk.agents.interfaces import Situation
from cowalk.sim.motion import Array, arc_displacement, compose, unit_arc, world_to_base

from .settings import NegotiationSettings

_NEIGHBOURS = np.array([-1, 0, 1])
_TINY = 1e-12


def minimise(cost: Callable[[Array], Array], low: Array, high: Array, points: int = 33) -> Array:
    """Return where a cost over an interval is least: two grids, then a parabola's vertex.

    A grid finds the lowest of several valleys and a minimum at a bound, which bracketing
    methods do not, and costs a handful of array operations for any number of lanes.

    Parameters
    ----------
    cost : callable
        Takes an array of shape (..., n) and returns the cost of each element.
    low, high : ndarray, shape (...)
        One of its axes may be 1 where the cost has more lanes: they then share the first grid.
    points : int
        Number of points of each grid; the second covers two cells of the first.

    Returns
    -------
    ndarray, shape (...)
        A place for every lane of the cost.
    """
    left, width = low[..., None], (high - low)[..., None]
    for _ in range(2):
        value = cost(left + width * _grid(points))
        best = np.minimum(np.maximum(value.argmin(axis=-1), 1), points - 2)[..., None]
        cell = width / (points - 1)
        left, width = left + (best - 1) * cell, 2.0 * cell
    lowest = np.take_along_axis(value, best + _NEIGHBOURS, axis=-1)
    before, here, after = lowest[..., 0], lowest[..., 1], lowest[..., 2]
    bend = before - 2.0 * here + after
    shift = 0.5 * (before - after) / np.where(bend > 0.0, bend, np.inf)
    inside = np.minimum(np.maximum(shift, -1.0), 1.0)[..., None]  # np.clip takes longer
    return np.asarray((left + (1.0 + inside) * cell)[..., 0])


@cache
def _grid(points: int) -> Array:
    return np.linspace(0.0, 1.0, points)


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
    def front(self, share: Array, own: Array, human: Array, gap: Array) -> tuple[Array, Array]:
        """Return points of the Pareto front between the two wishes, and what they cost.

        A point minimises share * J + (1 - share) * |(p - p_H)/p_ub|^2, both normed to lie
        between 0 at one side's wish and 1 at the other's.

        Parameters
        ----------
        share : ndarray, shape (..., n)
            Weight of the automation, 0 (the human's wish) to 1 (its own).
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

    def front(self, share: Array, own: Array, human: Array, gap: Array) -> tuple[Array, Array]:
        """See `Problem.front`; in one dimension it is the interval between the wishes."""
        points = self._at_pace(human[..., None, 1] + share * (own - human)[..., None, 1])
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
        lanes = (*pose.shape[:-1], 1)
        low, high = self._lower[..., 1:], self._upper[..., 1:]
        self._turns = np.broadcast_to(low, lanes), np.broadcast_to(high, lanes)
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
        lanes = self._pose.shape[:-1]
        nobody = np.zeros((*lanes, 2))
        return self._best(np.ones((*lanes, 1)), np.zeros((*lanes, 1)), nobody)[0][..., 0, :]

    def front(self, share: Array, own: Array, human: Array, gap: Array) -> tuple[Array, Array]:
        """See `Problem.front`."""
        human_gap = ((own - human) ** 2 * self._scale).sum(axis=-1)[..., None]
        own_weight = share / np.maximum(gap, _TINY)
        return self._best(own_weight, (1.0 - share) / np.maximum(human_gap, _TINY), human)

    def _best(self, own_weight: Array, human_weight: Array, human: Array) -> tuple[Array, Array]:
        """Minimise own_weight * J + human_weight * |(p - p_H)/p_ub|^2; return points and J."""
        lanes, scale = self._pose.shape[:-1], self._scale
        own = own_weight[..., None]
        v_weight = human_weight[..., None] * scale[..., 0]
        omega_weight = human_weight[..., None] * scale[..., 1]
        v_human, omega_human = human[..., None, None, 0], human[..., None, None, 1]
        asked, slowest, fastest = v_weight * v_human, self._lower[..., 0], self._upper[..., 0]

        def solve(omega: Array) -> tuple[Array, Array, Array]:
            """Return the best v, what is minimised there, and J."""
            a, b, c = (x.reshape(omega.shape) for x in self._parabola(omega.reshape(*lanes, -1)))
            free = (own * b + asked) / (own * a + v_weight)
            v = np.minimum(np.maximum(free, slowest), fastest)  # np.clip takes longer
            cost = (a * v - 2.0 * b) * v + c
            slower, turned = v - v_human, omega - omega_human
            away = v_weight * (slower * slower) + omega_weight * (turned * turned)
            return v, own * cost + away, cost

        omega = minimise(lambda turn: solve(turn)[1], *self._turns, points=17)
        v, _, cost = solve(omega[..., None])
        return np.stack((v[..., 0], omega), axis=-1), cost[..., 0]


PROBLEMS: dict[str, type[Problem]] = {"omega": TurnProblem, "both": TwistProblem}
"""The problem that each choice of `NegotiationSettings.dimensions` poses."""
