"""Drive of the mobile base: linear tyre slip with finite gains and limits, in plain floats."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class DriveParameters:
    """What the wheels can do. Every number is inferred: a small indoor walking assistant.

    Parameters
    ----------
    gain_forward, gain_sideways : float
        Tyre force per slip speed along and across the base, N s/m.
    gain_yaw : float
        Torque per slip of the turning rate, N m s/rad.
    max_force, max_torque : float
        Limits of the motors along the base (N) and about it (N m).
    max_speed, max_rate : float
        Limits of the command, m/s and rad/s.
    max_acceleration, max_rate_change : float
        Slope with which the command is approached, m/s^2 and rad/s^2.
    """

    gain_forward: float = 2000.0
    gain_sideways: float = 4000.0
    gain_yaw: float = 150.0
    max_force: float = 300.0
    max_torque: float = 80.0
    max_speed: float = 1.5
    max_rate: float = 1.5
    max_acceleration: float = 0.5
    max_rate_change: float = 1.0


class SlipDrive:
    """Force of the ground on the base: F = k (v_cmd - v), linear in the slip.

    Held twist errors follow: a push F along the base lets it slip by F / gain_forward, a push
    across it by F / gain_sideways, a torque M by M / gain_yaw.

    Parameters
    ----------
    parameters : DriveParameters
    mass, inertia : float
        Of the base, kg and kg m^2. A gain is capped at half of what would take the whole slip
        away within one physics step, so that slow physics stays stable.
    step : float
        Physics step in s.
    """

    def __init__(
        self, parameters: DriveParameters, mass: float, inertia: float, step: float
    ) -> None:
        self._gain_forward = min(parameters.gain_forward, 0.5 * mass / step)
        self._gain_sideways = min(parameters.gain_sideways, 0.5 * mass / step)
        self._gain_yaw = min(parameters.gain_yaw, 0.5 * inertia / step)
        self._max_force = parameters.max_force
        self._max_torque = parameters.max_torque
        self._max_speed = parameters.max_speed
        self._max_rate = parameters.max_rate
        self._speed_slope = parameters.max_acceleration * step
        self._rate_slope = parameters.max_rate_change * step
        self.reset()

    def reset(self) -> None:
        """Forget the command: at rest."""
        self._speed = self._rate = self._speed_goal = self._rate_goal = 0.0

    def command(self, speed: float, rate: float) -> None:
        """Set the twist to approach, m/s and rad/s; cut to the limits."""
        self._speed_goal = max(-self._max_speed, min(self._max_speed, speed))
        self._rate_goal = max(-self._max_rate, min(self._max_rate, rate))

    def wrench(self, forward: float, sideways: float, rate: float) -> tuple[float, float, float]:
        """Return the ground's force and torque for the next physics step, base axes.

        Parameters
        ----------
        forward, sideways, rate : float
            Velocity of the base in its own axes, m/s, m/s, rad/s.

        Returns
        -------
        (fx, fy, torque)
            N, N, N m.
        """
        gap = self._speed_goal - self._speed
        slope = self._speed_slope
        self._speed += slope if gap > slope else -slope if gap < -slope else gap
        gap = self._rate_goal - self._rate
        slope = self._rate_slope
        self._rate += slope if gap > slope else -slope if gap < -slope else gap

        force = self._gain_forward * (self._speed - forward)
        limit = self._max_force
        force = limit if force > limit else -limit if force < -limit else force
        torque = self._gain_yaw * (self._rate - rate)
        limit = self._max_torque
        torque = limit if torque > limit else -limit if torque < -limit else torque
        return force, -self._gain_sideways * sideways, torque
