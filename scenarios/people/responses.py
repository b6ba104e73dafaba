"""How a human answers a robot that yields, half yields or does not: simulated without a plant."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from cowalk.agents.basics.protocols import Human
from cowalk.sim.basics.motion import Array, TwistBounds, arc_displacement, compose
from cowalk.sim.basics.observation import OBSTACLE_COLUMNS, OBSTACLE_ROWS, Observation
from cowalk.sim.basics.path import Path
from cowalk.sim.basics.situation import Situation

SITUATION = Situation(
    Path(((0.0, 0.0), (60.0, 0.0))), 0.8, TwistBounds((0.0, -0.5), (1.2, 0.5)), 0.05
)
"""A straight walk at the shipped bounds."""
ROBOT = np.array([0.6, 0.0])
"""What the robot wants: straight on, m/s and rad/s, a quarter slower than the human."""
OFFSET = -0.6
"""Where the robot starts beside the human's path, m: the human wants to turn left."""
RESPONSE = 0.3
"""Time constant with which the robot's twist follows what it concedes, s."""
SAMPLES = 12
LEAST, BLOCK, MOST = 30.0, 10.0, 90.0
"""A held disagreement lasts at least the first, s, and at most the last; in between it ends
once the means of two blocks are the same."""
SAME = 1e-3
"""Stubbornness that differs by less has settled."""
AGREED = 0.005
"""Mean disagreement, as a share of the upper bound, below which nothing is left to insist on."""
JUMP = 0.05
"""A settled stubbornness that changes by more between neighbouring concessions jumps there."""
HALVINGS = 7


@dataclass(frozen=True)
class Answer:
    """How a human answered, a row a control step.

    Attributes
    ----------
    time : ndarray, shape (steps,)
        s.
    force : ndarray, shape (steps, 2)
        N, base axes.
    stubbornness : ndarray, shape (steps, 2)
        True stubbornness, 1.
    """

    time: Array
    force: Array
    stubbornness: Array


def answer(
    human: Human, concession: float, duration: float = 12.0, held: bool = False, seed: int = 0
) -> Answer:
    """Return how a human answers a robot that concedes a fixed share of every disagreement.

    The robot goes for p_A + concession (p_H - p_A), p_H as far as the bounds allow it, with a
    time constant of 0.3 s. It starts
    0.6 m to the right of where the human wants to walk, and wants to go straight on at 0.6 m/s
    where the human wants 0.8 m/s.

    Parameters
    ----------
    human : Human
    concession : float
        Share, in [0, 1].
    duration : float
        s.
    held : bool
        Whether the robot is kept at its offset and heading, as on a treadmill, so that the
        disagreement about omega does not end where the human gets their way.
    seed : int
        Seed of the human's generator.
    """
    steps = round(duration / SITUATION.period)
    found = list(islice(_steps(human, np.asarray(concession), held, seed), steps))
    force, stubbornness, _ = (np.array(values) for values in zip(*found, strict=True))
    return Answer(SITUATION.period * np.arange(steps, dtype=float), force, stubbornness)


def _steps(
    human: Human, concession: Array, held: bool, seed: int
) -> Iterator[tuple[Array, Array, Array]]:
    """Yield force, stubbornness and disagreement, a share of the upper bounds, of each step.

    Of one human for a concession of shape (), of a batch for one of shape (lanes,).
    """
    lanes, share = concession.shape, concession[..., None]
    human.reset(np.random.default_rng(seed), SITUATION)
    lower, upper = (np.asarray(b) for b in (SITUATION.bounds.lower, SITUATION.bounds.upper))
    follow = -np.expm1(-SITUATION.period / RESPONSE)
    pose, twist = np.zeros((*lanes, 3)), np.broadcast_to(ROBOT, (*lanes, 2))
    pose[..., 1] = OFFSET
    felt, time = np.zeros((*lanes, 2)), 0
    torque = np.zeros((*lanes, 4))  # and the force's third component
    while True:
        felt = human.act(
            Observation(
                twist=twist.copy(),
                force=np.repeat(felt[..., None, :], SAMPLES, axis=-2),
                wrench=np.repeat(
                    np.concatenate((felt, torque), axis=-1)[..., None, :], SAMPLES, -2
                ),
                force_valid=np.ones((*lanes, SAMPLES)),
                pose=pose.copy(),
                pose_world=pose.copy(),  # the path is the world's x axis
                obstacles=np.zeros((*lanes, OBSTACLE_ROWS, OBSTACLE_COLUMNS)),
                time=np.full((*lanes, 1), SITUATION.period * time),
            )
        )
        truth = human.truth()
        yield felt, truth.stubbornness, np.abs(truth.wish - twist) / upper
        # A force that is prescribed has no wish: there is nothing to concede.
        wish = np.where(np.isnan(truth.wish), ROBOT, np.clip(truth.wish, lower, upper))
        twist = twist + follow * (ROBOT + share * (wish - ROBOT) - twist)
        pose = compose(pose, arc_displacement(twist, SITUATION.period))
        time += 1
        if held:
            pose[..., 1:] = OFFSET, 0.0


def settled_stubbornness(human: Human, concessions: Array, seeds: int = 3) -> Array:
    """Return the stubbornness that a human settles at under each constant concession.

    Each disagreement is held for 30 s, then until the mean over 10 s no longer changes, for at
    most 90 s. The mean of the last 10 s counts.

    Parameters
    ----------
    human : Human
    concessions : ndarray, shape (n,)
        In [0, 1].
    seeds : int
        Runs to average over, for a human who draws.

    Returns
    -------
    ndarray, shape (n, 2)
        In v and in omega, in [0, 1]; NaN where they have come to agree, and stubbornness has
        nothing to insist on.
    """
    runs = seeds if draws(human) else 1
    if _takes_lanes(human):
        found = _settle(human, np.tile(concessions, runs), 0).reshape(runs, -1, 2)
    else:
        each = ((np.asarray(c), seed) for seed in range(runs) for c in concessions)
        found = np.array([_settle(human, *one) for one in each]).reshape(runs, -1, 2)
    return np.asarray(found.mean(axis=0))


def _takes_lanes(human: Human) -> bool:
    """Return whether a batch of a human answers as one: a class of a user's need not say it."""
    if not getattr(human, "broadcasts", True):
        return False
    try:
        force, stubbornness, left = next(_steps(human, np.zeros(3), True, 0))
    except Exception:  # such a class may fail at it in any way
        return False
    return force.shape == stubbornness.shape == left.shape == (3, 2)


def _settle(human: Human, concession: Array, seed: int) -> Array:
    """Return the stubbornness that held disagreements settle at, shape (..., 2)."""
    steps = _steps(human, concession, True, seed)
    size, blocks = round(BLOCK / SITUATION.period), round(MOST / BLOCK)
    before = np.full((*concession.shape, 2), np.inf)
    settled, open_still = before, np.ones(concession.shape, dtype=bool)
    for block in range(1, blocks + 1):
        _, shares, left = (np.array(part) for part in zip(*islice(steps, size), strict=True))
        mean = shares.mean(axis=0)
        same = (block * BLOCK >= LEAST) & (np.abs(mean - before).max(axis=-1) < SAME)
        ends = open_still & (same | (block == blocks))
        value = np.where(left.mean(axis=0) < AGREED, np.nan, mean)
        settled = np.where(ends[..., None], value, settled)
        open_still = open_still & ~ends
        if not open_still.any():
            break
        before = mean
    return settled


def draws(human: Human) -> bool:
    """Return whether another generator makes a human act or want otherwise."""
    first, second = (answer(human, 0.5, 10.0, seed=seed) for seed in (0, 1))
    same = np.array_equal(first.force, second.force)
    shares = first.stubbornness, second.stubbornness
    return not (same and np.array_equal(*shares, equal_nan=True))


def fixed_points(
    concessions: Array, stubbornness: Array, settle: Callable[[Array], Array]
) -> tuple[list[float], list[float]]:
    """Return where settled stubbornness equals the concession, and where it jumps past it.

    Equality is where the paper's automation rests: with interaction bounds of -2 and 2 its
    utility loss settles at the stubbornness that it reads. Where the curve jumps from one side
    to the other it has no value in between, and nothing rests there.

    Parameters
    ----------
    concessions, stubbornness : ndarray, shape (n,)
        Rising; in [0, 1], NaN where there is none.
    settle : callable
        Settled stubbornness, shape (m,), at concessions between them; called once at most.

    Returns
    -------
    points, jumps : list of float
        Concessions, rising.
    """
    above = stubbornness - concessions
    points = [float(c) for c, gap in zip(concessions, above, strict=True) if gap == 0.0]
    jumps: list[float] = []
    crossed = np.flatnonzero(above[:-1] * above[1:] < 0.0)
    if not len(crossed):
        return sorted(points), jumps
    # All that halving may ask for, in one batch: that takes no longer than two or three alone.
    fine = np.linspace(concessions[crossed], concessions[crossed + 1], 2**HALVINGS + 1, axis=-1)
    inside = fine[:, 1:-1]
    between = settle(inside.ravel()).reshape(inside.shape) - inside
    for i, places, middle in zip(crossed, fine, between, strict=True):
        row = [above[i], *middle, above[i + 1]]
        low, high = 0, 2**HALVINGS
        while high - low > 1:
            half = (low + high) // 2
            low, high = (half, high) if row[half] * row[low] > 0.0 else (low, half)
        ends = [float(places[low]), float(places[high])]
        gaps = [float(row[low]), float(row[high])]
        share = gaps[0] / (gaps[0] - gaps[1])
        met = ends[0] + share * (ends[1] - ends[0])
        (jumps if abs(gaps[0] - gaps[1]) > JUMP else points).append(met)
    return sorted(points), jumps


def push(duration: float, force: float, forward: bool = False) -> list[list[float]]:
    """Return the profile of an open-loop human who pushes, holds, and lets go sideways.

    Parameters
    ----------
    duration : float
        s; the push rises from 5 to 25 % of it and ends at 70 %.
    force : float
        N.
    forward : bool
        Whether half of it goes forward too.

    Returns
    -------
    list of [time, fx, fy]
        One row a control step, s and N.
    """
    time = np.arange(round(duration / SITUATION.period)) * SITUATION.period
    forces = force * np.clip((time / duration - 0.05) / 0.2, 0.0, 1.0) * (time < 0.7 * duration)
    return [
        [float(t), float(f) / 2.0 * forward, float(f)] for t, f in zip(time, forces, strict=True)
    ]
