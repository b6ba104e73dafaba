"""Stiffness and damping that the physics step cannot carry, refused before anything is built."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

from ..basics.errors import InputError
from ..body.grip import GripParameters
from ..body.walker import WalkerParameters
from .stability import GROWTH, Linear, Masses

RESERVE = 1.25
"""What all gains are multiplied by: a walking arm bends, and then moves less mass (inferred)."""
GAINS = (
    ("walker", "hand_stiffness"),
    ("walker", "hand_damping"),
    ("walker", "stiffness"),
    ("walker", "damping"),
    ("walker", "yaw_stiffness"),
    ("walker", "yaw_damping"),
    ("grip", "stiffness"),
    ("grip", "damping"),
    ("grip", "turn_stiffness"),
    ("grip", "turn_damping"),
)
DELAY = ("walker", "delay")
FASTER = (2, 4, 8, 16)
"""Multiples of the physics rate that are tried for an answer."""


@dataclass(frozen=True)
class Gains:
    """What holds the bodies together."""

    walker: WalkerParameters = WalkerParameters()
    grip: GripParameters = GripParameters()

    @property
    def changed(self) -> list[tuple[str, str]]:
        """Section and name of all that are not at their defaults."""
        usual = Gains()
        return [key for key in (*GAINS, DELAY) if self.get(*key) != usual.get(*key)]

    def get(self, section: str, name: str) -> Any:
        """Return one."""
        return getattr(getattr(self, section), name)

    def having(self, section: str, name: str, value: Any) -> Gains:
        """Return them with one replaced."""
        changed = replace(getattr(self, section), **{name: value})
        return replace(self, **{section: changed})

    def times(self, factor: float) -> Gains:
        """Return them all multiplied."""
        gains = self
        for key in GAINS:
            value = self.get(*key)
            if value == Gains().get(*key) and self.grip.kind == "rigid" and key[0] == "grip":
                continue  # a rigid grip has no gains but the wrist's
            more = tuple(factor * v for v in value) if isinstance(value, tuple) else factor * value
            gains = gains.having(*key, more)
        return gains


def refuse_unstable(bodies: Masses, gains: Gains, step: float, held: int) -> None:
    """Refuse gains with which the plant would shake itself apart.

    Parameters
    ----------
    bodies : Masses
    gains : Gains
    step : float
        Physics step, s.
    held : int
        Physics steps for which the human's forces are held.

    Raises
    ------
    InputError
        With the parameter, and the largest or smallest value that works with the rest as it is;
        for the drive's gains too.
    """
    linear = Linear(bodies, step)
    if _stable(linear, gains, held):
        return
    for section, name in gains.changed:
        value = gains.get(section, name)
        if (best := _limit(linear, gains, held, section, name)) is not None:
            shown, works = f"{section}.{name} = {_shown(value)}", f"{_shown(best)} works here"
            what = (
                f": the bodies would diverge at a physics step of {1e3 * step:.2g} ms; at most "
                f"{works}, or raise rates.physics"
            )
            if _largest(value) < _largest(best):
                what = f": the bodies would diverge; at least {works}"
            elif name == "delay":
                what = f" s: the legs would swing up; at most {works}"
            raise InputError(f"{shown}{what}", (section, name))
    if gains.changed and _stable(linear, Gains(), held):
        names = ", ".join(f"{section}.{name}" for section, name in gains.changed)
        raise InputError(f"{names}: together they would let the bodies diverge; see docs/plant.md")
    if (latest := _latest(linear, gains, held)) is not None:
        body = bodies.human.parameters
        raise InputError(
            f"walker.delay = {gains.walker.delay:g} s: the legs of this body "
            f"({body.height:g} m, {body.mass:g} kg) would swing up; at most {latest:g} works here, "
            "or lower walker.damping and walker.yaw_damping",
            ("walker", "delay"),
        )
    rate = round(1.0 / step)
    enough = (n for n in FASTER if _stable(Linear(bodies, step / n), gains, held))
    cure = next((f"{n * rate} works" for n in enough), "the robot or its load may be too light")
    raise InputError(
        f"rates.physics = {rate} Hz: too slow for these bodies, which would diverge; {cure}",
        ("rates", "physics"),
    )


def _stable(linear: Linear, gains: Gains, held: int) -> bool:
    strained = gains.times(RESERVE)
    grip = gains.grip
    may_be_lost = grip.release_force is not None or grip.slip_force is not None
    return all(
        linear.growth(strained.walker, strained.grip, held, lost) <= 1.0 + GROWTH
        for lost in ((False, True) if may_be_lost else (False,))
    )


def _latest(linear: Linear, gains: Gains, held: int) -> float | None:
    """Return the longest delay that works, whole updates, s; None if not even none does."""
    period = linear.step * held
    delays = (n * period for n in range(round(gains.walker.delay / period) - 1, -1, -1))
    works = (delay for delay in delays if _stable(linear, gains.having(*DELAY, delay), held))
    return next((math.floor(1e4 * delay) / 1e4 for delay in works), None)


def _limit(linear: Linear, gains: Gains, held: int, section: str, name: str) -> Any:
    """Return the value nearest to the given one that works, or None if not even the default."""
    usual, given = Gains().get(section, name), gains.get(section, name)

    def between(share: float) -> Any:
        if isinstance(usual, tuple):  # bodies on planar joints feel x, y, and the turn about z
            acting = (2,) if name.startswith("turn") else (0, 1)
            axes = enumerate(zip(usual, given, strict=True))
            return tuple(_between(u, g, share) if axis in acting else g for axis, (u, g) in axes)
        return _between(usual, given, share)

    works, fails = 0.0, 1.0
    if not _stable(linear, gains.having(section, name, between(works)), held):
        return None
    while fails - works > 1e-3:
        middle = 0.5 * (works + fails)
        if _stable(linear, gains.having(section, name, between(middle)), held):
            works = middle
        else:
            fails = middle
    return between(works)


def _between(usual: float, given: float, share: float) -> float:
    """Return a number between two, in ratio if it can be, with two digits, towards the first."""
    if share == 0.0 or usual == given:
        return usual
    ratio = usual > 0.0 and given > 0.0
    found = usual * (given / usual) ** share if ratio else usual + share * (given - usual)
    digits = 1 - math.floor(math.log10(found)) if found > 0.0 else 0
    towards = math.ceil if usual > given else math.floor
    return float(f"{towards(found * 10.0**digits) / 10.0**digits:.2g}")


def _largest(value: Any) -> float:
    return float(max(value) if isinstance(value, tuple) else value)


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(f'{item:g}' for item in value)})"
    return f"{value:g}"
