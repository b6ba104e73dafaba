"""Drive of the mobile base: command, delay, limits, and linear tyre slip, in plain floats."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any

from ..basics.errors import InputError
from ..basics.validators import Range, require_choices, require_effect, require_ranges
from .wheels import limited

DRIVES = ("slip", "wheels")
ONLY = {
    "slip": ("gain_forward", "gain_sideways", "gain_yaw", "max_torque"),
    "wheels": ("friction",),
}
"""What has an effect with one kind alone."""
RANGES: dict[str, Range] = {
    "gain_forward": (10.0, 1e6, "N s/m"),
    "gain_sideways": (10.0, 1e6, "N s/m"),
    "gain_yaw": (1.0, 1e5, "N m s/rad"),
    "max_force": (1.0, 1e4, "N"),
    "max_torque": (1.0, 1e4, "N m"),
    "max_speed": (0.01, 5.0, "m/s"),
    "max_rate": (0.01, 10.0, "rad/s"),
    "max_acceleration": (0.01, 100.0, "m/s^2"),
    "max_rate_change": (0.01, 100.0, "rad/s^2"),
    "wheel_track": (0.05, 2.0, "m"),
    "wheel_radius": (0.02, 0.5, "m"),
    "max_wheel_speed": (0.1, 500.0, "rad/s"),
    "delay": (0.0, 1.0, "s"),
    "friction": (0.05, 3.0, ""),
}
"""What a base that walks with people can have (inferred); outside it does not move, or stop."""


@dataclass(frozen=True)
class DriveParameters:
    """What the wheels can do. Every number is inferred: a small indoor walking assistant.

    Parameters
    ----------
    kind : {"slip", "wheels"}
        Linear tyre slip on a base that cannot tip, or wheels with friction on a floor, which
        put the contact solver's noise on the force (docs/plant.md has the numbers).
    gain_forward, gain_sideways : float
        Tyre force per slip speed along and across the base, N s/m. Slip only.
    gain_yaw : float
        Torque per slip of the turning rate, N m s/rad. Slip only. Defaults are lowered to what
        the physics step carries (`slip_gains`), a gain of one's own above that is refused.
    max_force, max_torque : float
        Limits of the motors along the base (N) and about it (N m); the latter for slip only.
        Across the base the ground holds whatever comes.
    max_speed, max_rate : float
        Limits of the command, m/s and rad/s.
    max_acceleration, max_rate_change : float
        Slope with which the command is approached, m/s^2 and rad/s^2.
    wheel_track, wheel_radius : float
        Distance of the two driven wheels, and their radius, m.
    max_wheel_speed : float
        rad/s.
    delay : float
        From a command to its effect, s.
    friction : float
        Of the tyres. Wheels only.

    Raises
    ------
    InputError
        If the kind is unknown, a number is outside of `RANGES`, or one is given that has no
        effect with the kind.
    """

    kind: str = "slip"
    gain_forward: float = 2000.0
    gain_sideways: float = 4000.0
    gain_yaw: float = 150.0
    max_force: float = 300.0
    max_torque: float = 80.0
    max_speed: float = 1.5
    max_rate: float = 1.5
    max_acceleration: float = 0.5
    max_rate_change: float = 1.0
    wheel_track: float = 0.42
    wheel_radius: float = 0.10
    max_wheel_speed: float = 20.0
    delay: float = 0.0
    friction: float = 0.9

    def __post_init__(self) -> None:
        require_choices(self, {"kind": DRIVES})
        require_ranges(self, RANGES)
        require_effect(self, ONLY)


class Command:
    """The twist that the motors are asked for: limited, delayed, and approached by slopes.

    Parameters
    ----------
    parameters : DriveParameters
    step : float
        Physics step in s.
    """

    def __init__(self, parameters: DriveParameters, step: float) -> None:
        p = parameters
        self._limits = (
            p.max_speed,
            p.max_rate,
            p.wheel_track,
            p.max_wheel_speed * p.wheel_radius,
        )
        self._speed_slope = p.max_acceleration * step
        self._rate_slope = p.max_rate_change * step
        self._late = round(p.delay / step)
        self.reset()

    def reset(self, speed: float = 0.0, rate: float = 0.0) -> tuple[float, float]:
        """Forget the command, at a twist (m/s, rad/s), and return it as the limits leave it."""
        self._goal = goal = limited((speed, rate), *self._limits)
        self._speed, self._rate = goal
        self._under_way = deque([goal] * self._late)
        return goal

    def set(self, speed: float, rate: float) -> None:
        """Set the twist to approach, m/s and rad/s."""
        self._goal = limited((speed, rate), *self._limits)

    def advance(self) -> tuple[float, float]:
        """Return the twist asked of the motors in the next physics step, m/s and rad/s."""
        speed, rate = self._goal
        if self._late:
            self._under_way.append(self._goal)
            speed, rate = self._under_way.popleft()
        if speed == self._speed and rate == self._rate:
            return speed, rate
        gap = speed - self._speed
        slope = self._speed_slope
        self._speed += slope if gap > slope else -slope if gap < -slope else gap
        gap = rate - self._rate
        slope = self._rate_slope
        self._rate += slope if gap > slope else -slope if gap < -slope else gap
        return self._speed, self._rate

    def save(self) -> tuple[Any, ...]:
        """Return what `restore` takes."""
        return self._goal, self._speed, self._rate, tuple(self._under_way)

    def restore(self, saved: tuple[Any, ...]) -> None:
        """Go on from a saved state."""
        self._goal, self._speed, self._rate, under_way = saved
        self._under_way = deque(under_way)


def slip_gains(
    parameters: DriveParameters, mass: float, inertia: float, step: float
) -> tuple[float, float, float]:
    """Return the gains forward, sideways (N s/m) and in yaw (N m s/rad) of a base.

    One may take away at most half of the slip within a physics step, so that slow physics stays
    stable. Defaults are lowered to that.

    Parameters
    ----------
    parameters : DriveParameters
    mass, inertia : float
        Of the base, kg and kg m^2.
    step : float
        Physics step in s.

    Raises
    ------
    InputError
        If a gain that is not the default is above that.
    """
    gains, usual = [], DriveParameters()
    for name, moved in (
        ("gain_forward", mass),
        ("gain_sideways", mass),
        ("gain_yaw", inertia),
    ):
        gain, most = getattr(parameters, name), 0.5 * moved / step
        if gain > most and gain != getattr(usual, name):
            unit, what = RANGES[name][2], "kg m^2" if name == "gain_yaw" else "kg"
            raise InputError(
                f"drive.{name} = {gain:g} {unit}: a base of {moved:.3g} {what} and a physics step "
                f"of {1e3 * step:.2g} ms carry at most {most:.4g}; lower it or raise rates.physics",
                ("drive", name),
            )
        gains.append(min(gain, most))
    forward, sideways, yaw = gains
    return forward, sideways, yaw


class SlipDrive:
    """Force of the ground on the base: F = k (v_cmd - v), linear in the slip.

    Held twist errors follow: a push F along the base lets it slip by F / gain_forward, a push
    across it by F / gain_sideways, a torque M by M / gain_yaw.

    Parameters
    ----------
    parameters : DriveParameters
    gains : (forward, sideways, yaw)
        From `slip_gains`, N s/m and N m s/rad.
    step : float
        Physics step in s.
    """

    def __init__(
        self, parameters: DriveParameters, gains: tuple[float, float, float], step: float
    ) -> None:
        self._gain_forward, self._gain_sideways, self._gain_yaw = gains
        self._max_force = parameters.max_force
        self._max_torque = parameters.max_torque
        self.command = Command(parameters, step)
        self._advance = self.command.advance

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
        wanted, wanted_rate = self._advance()
        force = self._gain_forward * (wanted - forward)
        limit = self._max_force
        force = limit if force > limit else -limit if force < -limit else force
        torque = self._gain_yaw * (wanted_rate - rate)
        limit = self._max_torque
        torque = limit if torque > limit else -limit if torque < -limit else torque
        return force, -self._gain_sideways * sideways, torque
