"""The linear-quadratic game of two who push one double integrator, in closed form.

x_1' = x_2, x_2' = steering (u_1 + u_2), and player i minimises the integral of
q_1 x_1^2 + q_2 x_2^2 + r u_i^2. Against a partner who plays u_j = -l x, the algebraic Riccati
equation of x' = (A - B l) x + B u_i has the solution that `best_answer` returns, the root of

    r g_1^2 + 2 r l_1 g_1 = q_1,  r g_2^2 + 2 r l_2 g_2 = q_2 + 2 r g_1/steering

for which the loop is stable. The equilibrium that a human begins in is found once, by scipy's
Riccati solver (`regulator`). In a control step the closed form takes its place: it costs less
than a thousandth, and broadcasts. The tests hold the two against each other.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ...basics.elementwise import Elementwise, Value

Gains = tuple[Value, Value]
"""Gains (l_1, l_2) of u = -l x: floats, or arrays of shape (...)."""

_ROUNDS = 500
_SETTLED = 1e-9


def best_answer(
    m: Elementwise,
    partner: Gains,
    error_weights: tuple[float, float],
    effort_weight: float,
    steering: float,
) -> Gains:
    """Return the gains that cost least against a partner's gains.

    Parameters
    ----------
    m : Elementwise
    partner : Gains
    error_weights : (float, float)
        q_1 and q_2.
    effort_weight : float
        r.
    steering : float
        1/s.
    """
    position, rate = partner
    first = m.sqrt(position * position + error_weights[0] / effort_weight) - position
    second = m.sqrt(rate * rate + error_weights[1] / effort_weight + 2.0 * first / steering) - rate
    return first, second


def regulator(
    partner: tuple[float, float],
    error_weights: tuple[float, float],
    effort_weight: float,
    steering: float,
) -> tuple[float, float]:
    """Return the same as `best_answer` for one human, by scipy's Riccati solver.

    Parameters
    ----------
    partner : (float, float)
        Gains.
    error_weights, effort_weight, steering
        See `best_answer`.
    """
    # Slow to import, and needed for one model alone.
    from scipy.linalg import solve_continuous_are

    push = np.array([[0.0], [steering]])
    # The partner's law is part of what they steer.
    plant = np.array([[0.0, 1.0], [-steering * partner[0], -steering * partner[1]]])
    cost = solve_continuous_are(plant, push, np.diag(error_weights), [[effort_weight]])
    first, second = (push.T @ cost)[0] / effort_weight
    return float(first), float(second)


@lru_cache  # dozens of solutions, for people who mostly share their weights
def nash_equilibrium(
    error_weights: tuple[float, float],
    effort_weights: tuple[float, float],
    steering: float,
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the gains of both players when each is the best answer to the other.

    The coupled Riccati equations, solved one after the other (`regulator`) until nothing moves.

    Parameters
    ----------
    error_weights : (float, float)
        q_1 and q_2 of both.
    effort_weights : (float, float)
        r of the first and of the second player.
    steering : float
        1/s.

    Raises
    ------
    ArithmeticError
        If the answers do not settle.
    """
    own, other = (0.0, 0.0), (0.0, 0.0)
    for _ in range(_ROUNDS):
        answer = regulator(other, error_weights, effort_weights[0], steering)
        other = regulator(answer, error_weights, effort_weights[1], steering)
        moved = max(abs(a - b) for a, b in zip(answer, own, strict=True))
        own = answer
        if moved < _SETTLED:
            return own, other
    raise ArithmeticError(f"no Nash equilibrium after {_ROUNDS} answers; gains move by {moved:g}")
