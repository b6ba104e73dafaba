"""How a human answers a robot that yields, half yields or does not: simulated without a plant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cowalk.agents.interfaces import Human, Situation
from cowalk.sim.motion import Array, TwistBounds, arc_displacement, compose
from cowalk.sim.observation import OBSTACLE_COLUMNS, OBSTACLE_ROWS, Observation
from cowalk.sim.path import Path

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

    The robot goes for p_A + concession (p_H - p_A), with a time constant of 0.3 s. It starts
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
    time = SITUATION.period * np.arange(steps, dtype=float)
    force, stubbornness = np.empty((steps, 2)), np.empty((steps, 2))
    human.reset(np.random.default_rng(seed), SITUATION)
    follow = -np.expm1(-SITUATION.period / RESPONSE)
    pose, twist, felt = np.array([0.0, OFFSET, 0.0]), ROBOT, np.zeros(2)
    for step in range(steps):
        felt = human.act(
            Observation(
                twist=twist.copy(),
                force=np.tile(felt, (SAMPLES, 1)),
                wrench=np.tile((*felt, 0.0, 0.0, 0.0, 0.0), (SAMPLES, 1)),
                force_valid=np.ones(SAMPLES),
                pose=pose.copy(),
                pose_world=pose.copy(),  # the path is the world's x axis
                obstacles=np.zeros((OBSTACLE_ROWS, OBSTACLE_COLUMNS)),
                time=time[step : step + 1].copy(),
            )
        )
        truth = human.truth()
        force[step], stubbornness[step] = felt, truth.stubbornness
        twist = twist + follow * (ROBOT + concession * (truth.wish - ROBOT) - twist)
        pose = compose(pose, arc_displacement(twist, SITUATION.period))
        if held:
            pose[1:] = OFFSET, 0.0
    return Answer(time, force, stubbornness)


def settled_stubbornness(
    human: Human, concessions: Array, duration: float = 30.0, seeds: int = 3
) -> Array:
    """Return the stubbornness that a human settles at under each constant concession.

    Parameters
    ----------
    human : Human
    concessions : ndarray, shape (n,)
        In [0, 1].
    duration : float
        Length of each held disagreement in s; the mean of its last third counts.
    seeds : int
        Runs to average over, for a human who draws.

    Returns
    -------
    ndarray, shape (n, 2)
        In v and in omega, in [0, 1].
    """
    drawing = draws(human)
    settled = np.zeros((len(concessions), 2))
    for i, concession in enumerate(concessions):
        for seed in range(seeds if drawing else 1):
            shares = answer(human, float(concession), duration, held=True, seed=seed).stubbornness
            settled[i] += shares[-len(shares) // 3 :].mean(axis=0)
    return settled / (seeds if drawing else 1)


def draws(human: Human) -> bool:
    """Return whether another generator makes a human act or want otherwise."""
    first, second = (answer(human, 0.5, 10.0, seed=seed) for seed in (0, 1))
    same = np.array_equal(first.force, second.force)
    return not (same and np.array_equal(first.stubbornness, second.stubbornness))


def fixed_points(concessions: Array, stubbornness: Array) -> list[float]:
    """Return where a curve of stubbornness over concession meets concession = stubbornness.

    That line is the paper's automation at rest: with interaction bounds of -2 and 2 its
    utility loss settles at the stubbornness that it reads.

    Parameters
    ----------
    concessions, stubbornness : ndarray, shape (n,)
        Rising; in [0, 1].
    """
    above = stubbornness - concessions
    found = [float(c) for c, gap in zip(concessions, above, strict=True) if gap == 0.0]
    for i in np.flatnonzero(above[:-1] * above[1:] < 0.0):
        share = above[i] / (above[i] - above[i + 1])
        found.append(float(concessions[i] + share * (concessions[i + 1] - concessions[i])))
    return sorted(found)


def push(duration: float, force: float) -> list[list[float]]:
    """Return the profile of an open-loop human who pushes, holds, and lets go sideways.

    Parameters
    ----------
    duration : float
        s; the push rises from 5 to 25 % of it and ends at 70 %.
    force : float
        N.

    Returns
    -------
    list of [time, fx, fy]
        One row a control step, s and N.
    """
    time = np.arange(round(duration / SITUATION.period)) * SITUATION.period
    forces = force * np.clip((time / duration - 0.05) / 0.2, 0.0, 1.0) * (time < 0.7 * duration)
    return [[float(t), 0.0, float(f)] for t, f in zip(time, forces, strict=True)]
