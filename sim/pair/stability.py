"""The plant near rest as a linear map: whether an explicit physics step can carry it. Pure.

Springs and dampers act by forces that are worked out at the start of a step and held through it.
A single mass m on a spring k and damper b stays bounded under that only while
h^2 k/m + 2 h b/m < 4, h being the step. Here the masses hang together, some forces are held for
several steps, and the legs are late, so the whole map from one update of the human's forces to the
next is built, and asked for its largest eigenvalue: beyond 1 in magnitude, whatever moves grows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..basics.motion import Array
from ..body.anthropometry import yaw_inertia
from ..body.grip import GripParameters
from ..body.human_body import HumanBody
from ..body.walker import WalkerParameters, legs_of
from ..robot.drive import DriveParameters, slip_gains
from ..urdf.rigid import Rigid

GROWTH = 1e-6
"""Growth of an update that is rounding: where nothing holds a body, its motion just goes on."""


@dataclass(frozen=True)
class Masses:
    """What moves, in base axes, at rest.

    Attributes
    ----------
    base : Rigid
    load : Rigid or None
        Clamped to the base; its centre in base axes.
    human : HumanBody
    place : (x, y, theta)
        Of the trunk, m, m, rad.
    drive : DriveParameters
    """

    base: Rigid
    load: Rigid | None
    human: HumanBody
    place: tuple[float, float, float]
    drive: DriveParameters


class Linear:
    """Masses and levers at rest. Coordinates: base, trunk (x, y, yaw each), and the arms' joints.

    Parameters
    ----------
    bodies : Masses
    step : float
        Physics step, s.

    Raises
    ------
    InputError
        If it does not carry the drive's gains.
    """

    def __init__(self, bodies: Masses, step: float) -> None:
        human, (place_x, place_y, _) = bodies.human, bodies.place
        self.count = n = 6 + 2 * len(human.arms)
        self.step = step
        self.body = human.parameters
        mass = np.zeros((n, n))

        def add(weight: float, inertia: float, lever: Array, turn: Array) -> None:
            mass[:] += weight * lever.T @ lever + inertia * np.outer(turn, turn)

        base_turn, trunk_turn = np.eye(n)[2], np.eye(n)[5]
        for rigid in (bodies.base, bodies.load):
            if rigid is not None:
                centre = self._carried(0, rigid.centre[:2])
                add(rigid.mass, rigid.yaw_inertia, centre, base_turn)
        rows, angles = [], human.posture
        arms = sum(arm.upper.mass + arm.fore.mass for arm in human.arms)
        trunk = human.parameters.mass - arms
        add(trunk, yaw_inertia(human.parameters), self._carried(3, (0.0, 0.0)), trunk_turn)
        for index, arm in enumerate(human.arms):
            joint, (shoulder, elbow) = 6 + 2 * index, angles[2 * index : 2 * index + 2]
            ends: list[tuple[float, ...]] = [arm.shoulder]
            for number, (link, angle) in enumerate(
                ((arm.upper, shoulder), (arm.fore, shoulder + elbow))
            ):
                along = np.array([math.cos(angle), math.sin(angle)])
                turn = trunk_turn.copy()
                turn[joint : joint + 1 + number] = 1.0
                middle = tuple(ends[number] + link.centre * along)
                add(link.mass, link.inertia, self._arm(joint, ends, middle), turn)
                ends.append(tuple(ends[number] + link.length * along))
            hand = self._arm(joint, ends[:2], ends[2])
            handle = self._carried(0, (place_x + ends[2][0], place_y + ends[2][1]))
            # The posture spring turns the arm's joints alone; the trunk takes their reaction.
            own = hand * (np.arange(n) >= 6)
            rows.append((own, hand - handle, turn - base_turn))
        self._inverse = np.linalg.inv(mass)
        self._hands = rows
        # What trunk and joints do where all of it rides on the base as one.
        self._ridden = np.zeros((n - 3, 3))
        self._ridden[:2] = self._carried(0, (place_x, place_y))[:, :3]
        self._ridden[2, 2] = 1.0
        # Where the legs want the trunk, seen from the base (see `Walker`).
        self._legs = np.zeros((3, n))
        self._legs[:, 3:6] = np.eye(3)
        self._legs[:2] -= self._carried(0, (place_x, place_y))
        self._legs[2, 2] = -1.0
        # Wheels hold the base by friction and motors, in the same solver as the grip.
        slip = bodies.drive.kind == "slip"
        self._still = np.zeros((0, n)) if slip else np.eye(3, n)
        self._drive = np.zeros((n, n))
        if slip:
            base = bodies.base
            gains = slip_gains(bodies.drive, base.mass, base.yaw_inertia, step)
            self._drive[:3, :3] = np.diag(gains)

    def _carried(self, first: int, point: tuple[float, ...]) -> Array:
        """Return d(point)/d(coordinates), shape (2, n), of a point fixed to base or trunk."""
        lever = np.zeros((2, self.count))
        lever[0, first], lever[1, first + 1] = 1.0, 1.0
        lever[:, first + 2] = -point[1], point[0]
        return lever

    def _arm(self, joint: int, pivots: Any, point: tuple[float, ...]) -> Array:
        """Return the same of a point on an arm, that of a joint for each pivot before it."""
        lever = self._carried(3, point)
        for index, pivot in enumerate(pivots):
            lever[:, joint + index] = -(point[1] - pivot[1]), point[0] - pivot[0]
        return lever

    def growth(
        self, walker: WalkerParameters, grip: GripParameters, held: int, lost: bool
    ) -> float:
        """Return by what factor the fastest growing motion grows in an update.

        The base's place in the world is left out; beside it, 1 or less is a motion that stays.

        Parameters
        ----------
        walker, grip : WalkerParameters, GripParameters
            Gains.
        held : int
            Physics steps for which the human's forces are held.
        lost : bool
            Whether the hands have let go.
        """
        n, h, inverse = self.count, self.step, self._inverse
        spring, damper = np.zeros((n, n)), np.zeros((n, n))
        joined = [self._still]
        share = 1.0 / len(self._hands)
        for own, gap, wrist in self._hands:
            spring += share * walker.hand_stiffness * own.T @ own
            damper += share * walker.hand_damping * own.T @ own
            if lost:
                continue
            spring += grip.turn_stiffness[2] * np.outer(wrist, wrist)
            damper += grip.turn_damping[2] * np.outer(wrist, wrist)
            if grip.kind == "compliant":
                spring += gap.T @ np.diag(grip.stiffness[:2]) @ gap
                damper += gap.T @ np.diag(grip.damping[:2]) @ gap
            else:
                joined.append(gap)
        held_still = np.concatenate(joined)
        lever = inverse @ held_still.T
        free = np.eye(n) - lever @ np.linalg.pinv(held_still @ lever) @ held_still
        late = round(walker.delay / (h * held))
        gains = legs_of(walker, self.body)
        legs_k = np.array([gains.stiffness] * 2 + [gains.yaw_stiffness])[:, None] * self._legs
        legs_b = np.array([gains.damping] * 2 + [gains.yaw_damping])[:, None] * self._legs
        # The state: coordinates seen from the base, rates, and what the legs decided and have not
        # done yet. Where the base is does not matter, and with it a base that nothing holds would
        # have a defective eigenvalue of 1, which rounding moves by the root of its size.
        seen = n - 3
        size = seen + n + 3 * late
        force = np.zeros((n, size))
        force[:, :seen], force[:, seen : seen + n] = -spring[:, 3:], -damper
        legs = -np.concatenate((legs_k[:, 3:], legs_b), axis=1)
        if late:
            force[3:6, seen + n : seen + n + 3] += np.eye(3)
        else:
            force[3:6, : seen + n] += legs
        place, rate = np.eye(seen, size), np.eye(n, size, seen)
        keep, push = free @ (np.eye(n) - h * inverse @ self._drive), h * free @ inverse @ force
        for _ in range(held):
            rate = keep @ rate + push
            place = place + h * (rate[3:] - self._ridden @ rate[:3])
        step = np.zeros((size, size))
        step[:seen], step[seen : seen + n] = place, rate
        if late:
            step[seen + n : -3, seen + n + 3 :] = np.eye(3 * (late - 1))
            step[-3:, : seen + n] = legs
        return float(np.abs(np.linalg.eigvals(step)).max())
