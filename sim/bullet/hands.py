"""The hands of the human on what they hold, in the engine: joined, yielding, or lost."""

from __future__ import annotations

import math
from typing import Any

from ..basics.frames import Vector
from ..body.grip import Bushing, GripParameters
from ..body.human_body import HumanBody
from ..engine.engine import engine, force_on_parent
from .chains import Base, Chain, Slab, State

Wrench = tuple[float, float, float, float, float, float]
NOTHING: Wrench = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
UNBREAKABLE = 1e9
_REACTION = engine.getConstraintState


class Hands:
    """Every holding hand on its handle.

    A rigid grip is a point-to-point constraint each (its reaction is the force), a compliant one
    a `Bushing`; either passes on what torque the wrist has.

    Parameters
    ----------
    parameters : GripParameters
    client : int
    held : Base or Slab
        What is held.
    human : Chain
    body : HumanBody
    handles : tuple of (x, y, z)
        Where each hand holds, in the axes of what is held, m.
    reference : (x, y, z)
        Point about which the torque is reported, in the same axes, m.
    """

    def __init__(
        self,
        parameters: GripParameters,
        client: int,
        held: Base | Slab,
        human: Chain,
        body: HumanBody,
        handles: tuple[Vector, ...],
        reference: Vector,
    ) -> None:
        self._client = client
        self._breaks = parameters.release_force is not None
        self._release = (parameters.release_force or math.inf) ** 2
        self.yields = parameters.kind == "compliant"
        """Whether its forces have to be renewed in every physics step."""
        self._turn = (parameters.turn_stiffness[2], parameters.turn_damping[2])
        self.acts = self.yields or max(self._turn) > 0.0
        """Whether it has forces of its own, beside those of constraints."""
        posture = body.posture
        self._hands = tuple(
            (
                3 + 2 * index,
                *arm.shoulder,
                arm.upper.length,
                arm.fore.length,
                *handle[:2],
                posture[2 * index] + posture[2 * index + 1],
            )
            for index, (arm, handle) in enumerate(zip(body.arms, handles, strict=True))
        )
        self._joints = 3 + 2 * len(handles)
        self._levers = tuple(
            tuple(a - b for a, b in zip(handle, reference, strict=True)) for handle in handles
        )
        self._bushings = [Bushing(parameters) for _ in handles] if self.yields else []
        self._constraints: list[int] = []
        if not self.yields:
            rises = f"hand_{body.parameters.sides[0]}" in human.links
            for side, handle, pivot in zip(
                body.parameters.sides, handles, body.pivots, strict=True
            ):
                self._constraints.append(
                    engine.createConstraint(
                        held.body,
                        held.link,
                        human.body,
                        human.links[f"hand_{side}" if rises else f"forearm_{side}"],
                        engine.JOINT_POINT2POINT,
                        (0.0, 0.0, 0.0),
                        held.pivot(handle),
                        (0.0, 0.0, 0.0) if rises else pivot,
                        physicsClientId=client,
                    )
                )
        self.held = True
        """Whether the hands hold on."""
        self._forces: list[Vector] = [(0.0, 0.0, 0.0)] * len(handles)
        self._torque = 0.0
        self.simple = len(self._constraints) == 1
        """Whether one constraint is all there is to read."""

    def reset(self) -> None:
        """Take hold."""
        self._hold(True)
        self._forces = [(0.0, 0.0, 0.0)] * len(self._hands)
        self._torque = 0.0
        for bushing in self._bushings:
            bushing.anchor = (0.0, 0.0)

    def _hold(self, held: bool) -> None:
        if held == self.held:
            return
        self.held = held
        for constraint in self._constraints:
            engine.changeConstraint(
                constraint, maxForce=UNBREAKABLE if held else 0.0, physicsClientId=self._client
            )

    def save(self) -> tuple[Any, ...]:
        """Return what `restore` takes."""
        anchors = [bushing.anchor for bushing in self._bushings]
        return self.held, tuple(self._forces), self._torque, anchors

    def restore(self, saved: tuple[Any, ...]) -> None:
        """Go on from a saved state."""
        held, forces, self._torque, anchors = saved
        self._hold(held)
        self._forces = list(forces)
        for bushing, anchor in zip(self._bushings, anchors, strict=True):
            bushing.anchor = anchor

    def act(self, thing: State, human: State, forces: list[float]) -> Vector:
        """Add what the grips do to the human's joint forces, and return their wrench on the thing.

        Parameters
        ----------
        thing : (x, y, yaw, vx, vy, rate)
            State of what is held.
        human : (x, y, yaw, shoulder, elbow, ..., and their rates)
        forces : list of float
            Joint forces of the human, changed in place.

        Returns
        -------
        (fx, fy, torque)
            On the thing, about its origin, world axes: N, N, N m.
        """
        if not self.held:
            return 0.0, 0.0, 0.0
        x, y, yaw, vx, vy, rate = thing
        cos, sin = math.cos(yaw), math.sin(yaw)
        n = self._joints
        trunk_cos, trunk_sin = math.cos(human[2]), math.sin(human[2])
        stiffness, damping = self._turn
        total_x = total_y = total_turn = wrists = 0.0
        for index, hand in enumerate(self._hands):
            joint, shoulder_x, shoulder_y, upper, fore, handle_x, handle_y, rest = hand
            azimuth = human[2] + human[joint]
            bent = azimuth + human[joint + 1]
            bent_rate = human[n + 2] + human[n + joint] + human[n + joint + 1]
            torque = stiffness * (bent - yaw - rest) + damping * (bent_rate - rate)
            wrists += torque
            on_hand = (0.0, 0.0)
            arm_x, arm_y = upper * math.cos(azimuth), upper * math.sin(azimuth)
            fore_x, fore_y = fore * math.cos(bent), fore * math.sin(bent)
            out_x = trunk_cos * shoulder_x - trunk_sin * shoulder_y
            out_y = trunk_sin * shoulder_x + trunk_cos * shoulder_y
            if self.yields:
                at_x, at_y = cos * handle_x - sin * handle_y, sin * handle_x + cos * handle_y
                gap_x = human[0] + out_x + arm_x + fore_x - x - at_x
                gap_y = human[1] + out_y + arm_y + fore_y - y - at_y
                arm_rate = human[n + 2] + human[n + joint]
                own_vx = human[n] - human[n + 2] * out_y - arm_rate * arm_y - bent_rate * fore_y
                own_vy = human[n + 1] + human[n + 2] * out_x + arm_rate * arm_x + bent_rate * fore_x
                # Seen from the turning handle, so that a carried-along hand has no rate.
                slip_x = own_vx - vx + rate * (at_y + gap_y)
                slip_y = own_vy - vy - rate * (at_x + gap_x)
                bushing = self._bushings[index]
                along, across, up = bushing.force(
                    (cos * gap_x + sin * gap_y, cos * gap_y - sin * gap_x, 0.0),
                    (cos * slip_x + sin * slip_y, cos * slip_y - sin * slip_x, 0.0),
                )
                if bushing.lost:
                    self._hold(False)
                fx, fy = cos * along - sin * across, sin * along + cos * across
                self._forces[index] = (fx, fy, up)
                # The force acts where the hand is: equal and opposite, on one line.
                total_x += fx
                total_y += fy
                total_turn += (at_x + gap_x) * fy - (at_y + gap_y) * fx
                on_hand = (-fx, -fy)
            force_x, force_y = on_hand
            at_elbow = fore_x * force_y - fore_y * force_x - torque
            at_shoulder = at_elbow + arm_x * force_y - arm_y * force_x
            forces[0] += force_x
            forces[1] += force_y
            forces[2] += at_shoulder + out_x * force_y - out_y * force_x
            forces[joint] += at_shoulder
            forces[joint + 1] += at_elbow
        self._torque = wrists
        return total_x, total_y, total_turn + wrists

    def read(self, cos: float, sin: float) -> Wrench:
        """Return the hands' wrench on what is held, in its axes, about the reference point.

        Parameters
        ----------
        cos, sin : float
            Of the yaw of what is held.
        """
        if self.simple:
            # The reaction is that on the hand (see `force_on_parent`).
            fx, fy, fz = _REACTION(self._constraints[0], self._client)
            wrench = (-cos * fx - sin * fy, sin * fx - cos * fy, -fz, 0.0, 0.0, self._torque)
        else:
            wrench = self._sum(cos, sin)
        if self._breaks and wrench[0] * wrench[0] + wrench[1] * wrench[1] > self._release:
            self._hold(False)
            self._torque = 0.0
        return wrench

    def _sum(self, cos: float, sin: float) -> Wrench:
        if not self.held:
            return NOTHING
        for index, constraint in enumerate(self._constraints):
            self._forces[index] = force_on_parent(
                engine.JOINT_POINT2POINT, engine.getConstraintState(constraint, self._client)
            )
        along = across = up = roll = pitch = yaw = 0.0
        for (lx, ly, lz), (fx, fy, fz) in zip(self._levers, self._forces, strict=True):
            ax, ay = cos * fx + sin * fy, cos * fy - sin * fx
            along += ax
            across += ay
            up += fz
            roll += ly * fz - lz * ay
            pitch += lz * ax - lx * fz
            yaw += lx * ay - ly * ax
        return along, across, up, roll, pitch, yaw + self._torque
