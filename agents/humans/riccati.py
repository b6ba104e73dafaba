"""Linear-quadratic regulators of one player, and of two who share the same plant."""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_continuous_are

from cowalk.sim.motion import Array

_ROUNDS = 200
_SETTLED = 1e-10


def regulator(A: Array, B: Array, Q: Array, R: Array) -> Array:
    """Return L of u = -L x that minimises the integral of x'Qx + u'Ru for x' = Ax + Bu.

    L = R^-1 B'P, P the solution of the continuous algebraic Riccati equation.

    Parameters
    ----------
    A, B, Q, R : ndarray, shapes (n, n), (n, m), (n, n), (m, m)

    Returns
    -------
    ndarray, shape (m, n)
    """
    return np.linalg.solve(R, B.T @ solve_continuous_are(A, B, Q, R))


def nash(
    A: Array,
    B: Array,
    Q: tuple[Array, Array],
    R: tuple[Array, Array],
) -> tuple[Array, Array]:
    """Return the gains of two players in a feedback Nash equilibrium of x' = Ax + B(u_1 + u_2).

    Each gain is the regulator of the plant that the other's gain leaves, L_i for A - B L_j:
    the coupled Riccati equations, solved by answering each other in turn until nothing moves.

    Parameters
    ----------
    A, B : ndarray, shapes (n, n), (n, m)
    Q, R : pair of ndarray, shapes (n, n), (m, m)
        What an error and an effort cost each player.

    Returns
    -------
    (ndarray, ndarray), each of shape (m, n)

    Raises
    ------
    ArithmeticError
        If the answers do not settle.
    """
    first = second = np.zeros((B.shape[1], len(A)))
    for _ in range(_ROUNDS):
        answer = regulator(A - B @ second, B, Q[0], R[0])
        reply = regulator(A - B @ answer, B, Q[1], R[1])
        moved = max(np.abs(answer - first).max(), np.abs(reply - second).max())
        first, second = answer, reply
        if moved < _SETTLED:
            return first, second
    raise ArithmeticError(f"no Nash equilibrium after {_ROUNDS} rounds; gains move by {moved:g}")
