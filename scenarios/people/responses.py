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
    found = list(islice(_steps(human, concession, held, seed), steps))
    force, stubbornness, _ = (np.array(values) for values in zip(*found, strict=True))
    return Answer(SITUATION.period * np.arange(steps, dtype=float), force, stubbornness)


def _steps(
    human: Human, concession: float, held: bool, seed: int
) -> Iterator[tuple[Array, Array, Array]]:
    """Yield force, stubbornness and disagreement, a share of the upper bounds, of each step."""
    human.reset(np.random.default_rng(seed), SITUATION)
    lower, upper = (np.asarray(b) for b in (SITUATION.bounds.lower, SITUATION.bounds.upper))
    follow = -np.expm1(-SITUATION.period / RESPONSE)
    pose, twist, felt, time = np.array([0.0, OFFSET, 0.0]), ROBOT, np.zeros(2), 0
    while True:
        felt = human.act(
            Observation(
                twist=twist.copy(),
                force=np.tile(felt, (SAMPLES, 1)),
                wrench=np.tile((*felt, 0.0, 0.0, 0.0, 0.0), (SAMPLES, 1)),
                force_valid=np.ones(SAMPLES),
                pose=pose.copy(),
                pose_world=pose.copy(),  # the path is the world's x axis
                obstacles=np.zeros((OBSTACLE_ROWS, OBSTACLE_COLUMNS)),
                time=np.array([SITUATION.period * time]),
            )
        )
        truth = human.truth()
        yield felt, truth.stubbornness, np.abs(truth.wish - twist) / upper
        wish = np.clip(truth.wish, lower, upper)
        twist = twist + follow * (ROBOT + concession * (wish - ROBOT) - twist)
        pose = compose(pose, arc_displacement(twist, SITUATION.period))
        time += 1
        if held:
            pose[1:] = OFFSET, 0.0


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
    runs = range(seeds if draws(human) else 1)
    return np.array([np.mean([_settle(human, c, k) for k in runs], axis=0) for c in concessions])


def _settle(human: Human, concession: float, seed: int) -> Array:
    """Return the stubbornness that one held disagreement settles at, shape (2,)."""
    steps = _steps(human, float(concession), True, seed)
    size = round(BLOCK / SITUATION.period)
    before = np.full(2, np.inf)
    for block in range(1, round(MOST / BLOCK) + 1):
        _, shares, left = (np.array(part) for part in zip(*islice(steps, size), strict=True))
        settled = shares.mean(axis=0)
        if block * BLOCK >= LEAST and np.abs(settled - before).max() < SAME:
            break
        before = settled
    return np.where(left.mean(axis=0) < AGREED, np.nan, settled)


def draws(human: Human) -> bool:
    """Return whether another generator makes a human act or want otherwise."""
    first, second = (answer(human, 0.5, 10.0, seed=seed) for seed in (0, 1))
    same = np.array_equal(first.force, second.force)
    return not (same and np.array_equal(first.stubbornness, second.stubbornness))


def fixed_points(
    concessions: Array, stubbornness: Array, settle: Callable[[float], float]
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
        Settled stubbornness at a concession between them.

    Returns
    -------
    points, jumps : list of float
        Concessions, rising.
    """
    above = stubbornness - concessions
    points = [float(c) for c, gap in zip(concessions, above, strict=True) if gap == 0.0]
    jumps: list[float] = []
    for i in np.flatnonzero(above[:-1] * above[1:] < 0.0):
        ends = [float(concessions[i]), float(concessions[i + 1])]
        gaps = [float(above[i]), float(above[i + 1])]
        for _ in range(HALVINGS):
            middle = sum(ends) / 2.0
            gap = settle(middle) - middle
            side = 0 if gap * gaps[0] > 0.0 else 1
            ends[side], gaps[side] = middle, gap
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
