"""Checks for classes of your own: whether a human or an automation keeps its protocol.

``check_human(MyHuman())`` raises one `InputError` that lists every fault with its cure.
"""

from __future__ import annotations

import inspect
import pickle
import random
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.motion import Array

from ..basics.protocols import Truth
from .rules import (
    Broken,
    access_hint,
    belief_faults,
    call_faults,
    faint_faults,
    force_faults,
    insistence,
    one_line,
    require_pair,
    truth_faults,
    twist_faults,
)
from .walk import SITUATION, observations

_ANSWERS = 1e-3
"""Least difference of a force in N, or of a twist in m/s or rad/s, that counts as an answer."""
_OUTPUT = {
    "human": "return the hand force on the base in N, np.array([fx, fy])",
    "automation": "return the twist in m/s and rad/s, np.array([v, omega])",
}


def check_human(human: Any) -> None:
    """Check that an object keeps the protocol `Human`.

    It is walked for 8 s beside a made-up base that sets off from rest, turns, pushes, halts,
    loses samples, and passes obstacles. Checked are: signatures, shapes, finite and plausible
    forces, truth within [0, 1], repetition after a reset with an equal generator, another
    start of the generators it keeps after a reset with another one, global random state and
    observations left alone, and a force that answers the base's motion by 1 mN or more, the
    measured force being the same, unless the class says ``closed_loop = False``.

    Parameters
    ----------
    human : object
        An instance, or a class that can be built without arguments.

    Raises
    ------
    InputError
        If something is not right: all faults, each with its cure.
    """
    _raise(human, human_problems(human))


def check_automation(automation: Any) -> None:
    """Check that an object keeps the protocol `Automation`.

    As `check_human`; the twist must lie within the situation's bounds and answer the base's
    motion or the measured force, and the belief must lie within its ranges.

    Parameters
    ----------
    automation : object
        An instance, or a class that can be built without arguments.

    Raises
    ------
    InputError
        If something is not right: all faults, each with its cure.
    """
    _raise(automation, automation_problems(automation))


def human_problems(human: Any) -> list[str]:
    """Return every fault that `check_human` finds, each with its cure."""
    return _problems(human, "human", "truth", force_faults, truth_faults)


def automation_problems(automation: Any) -> list[str]:
    """Return every fault that `check_automation` finds, each with its cure."""
    return _problems(automation, "automation", "belief", twist_faults, belief_faults)


def _raise(part: Any, problems: list[str]) -> None:
    name = part.__name__ if inspect.isclass(part) else type(part).__name__
    if problems:
        raise InputError(f"{name}: " + "; ".join(problems))


Faults = Callable[[Any], Iterator[str]]


def _problems(part: Any, seat: str, report: str, outputs: Faults, reports: Faults) -> list[str]:
    if inspect.isclass(part):
        try:
            part = part()
        except (Exception, SystemExit) as error:
            what = one_line(error)
            return [f"it cannot be built without arguments ({what}): check an instance of it"]
    methods = {
        "reset": (("rng", "situation"), "reset(self, rng, situation)"),
        "act": (("observation",), f"act(self, observation), to {_OUTPUT[seat]}"),
        report: ((), f"{report}(self), to return a {report.capitalize()}"),
    }
    problems = list(call_faults(part, methods))
    if problems:
        return problems
    states = _global_states()
    found: dict[str, None] = {}  # each fault once, in order
    # A human must answer how the base moves; an automation may answer the push alone.
    calm = (0.3, 1.0 if seat == "human" else 0.3)
    try:
        # The first walk once more at the end: a class may count its resets.
        first, again, calmer, last = (
            _walk(part, report, sizes, outputs, reports, _OUTPUT[seat], found)
            for sizes in ((1.0, 1.0), (1.0, 1.0), calm, (1.0, 1.0))
        )
        found |= dict.fromkeys(_generator_faults(part))
    except Broken as error:
        return [*found, str(error)]
    problems = list(found)
    if _global_states() != states:
        problems.append(
            "it touches the global random state: draw from the rng that reset is given alone"
        )
    # NaN, named already, is not equal to itself.
    repeats = [
        np.isclose(first, other, rtol=0.0, atol=0.0, equal_nan=True) for other in (again, last)
    ]
    different = np.flatnonzero(~np.all(repeats, axis=(0, -1)))
    if different.size:
        problems.append(
            f"two walks after resets with equal generators differ from step {different[0]} on: set "
            "all state in reset, and draw only from the rng that reset is given"
        )
    elif not problems:
        problems += _loop_faults(part, seat, float(np.abs(first - calmer).max()))
    return problems


def _generator_faults(part: Any) -> Iterator[str]:
    """Yield which generators that a part keeps start alike, whatever reset is given."""
    drawn = _generators(part)  # after a walk that began with seed 7
    starts = []
    for seed in (7, 8):
        part.reset(np.random.default_rng(seed), SITUATION)
        starts.append(_generators(part))
    for name, start in starts[0].items():
        if start == starts[1].get(name) and start != drawn.get(name):
            yield (
                f"the generator self.{name} starts alike whatever rng reset is given, so that "
                f"every seed gives the same person: self.{name} = rng in reset"
            )


def _generators(part: Any) -> dict[str, bytes]:
    """Return the states of the generators of random numbers that a part keeps, by attribute."""
    found = {}
    for name, value in getattr(part, "__dict__", {}).items():
        if isinstance(value, np.random.Generator):
            found[name] = pickle.dumps(value.bit_generator.state)
        elif isinstance(value, random.Random):
            found[name] = pickle.dumps(value.getstate())
    return found


def _loop_faults(part: Any, seat: str, difference: float) -> Iterator[str]:
    output = "force" if seat == "human" else "twist"
    felt, motion = ("", "'s twist or pose") if seat == "human" else (" and is pushed", "")
    if getattr(part, "closed_loop", True) and difference < _ANSWERS:
        yield (
            f"its {output} is the same however the base moves{felt}: use the observation"
            f"{motion}, or say closed_loop = False in the class"
        )
    elif not getattr(part, "closed_loop", True) and difference > 0.0:
        yield f"it says closed_loop = False, yet its {output} answers the base: leave that out"


def _global_states() -> bytes:
    legacy = np.random.get_state()  # noqa: NPY002 - the global state is what is watched
    return pickle.dumps((legacy, random.getstate()))


def _walk(
    part: Any,
    report: str,
    sizes: tuple[float, float],
    outputs: Faults,
    reports: Faults,
    cure: str,
    found: dict[str, None],
) -> Array:
    """Step a part through one walk; return outputs, and note every fault.

    ``sizes`` scale how much the base moves to and fro, and how hard it is pushed.
    """
    step, verb = 0, "reset"
    kept: list[tuple[Array, Array]] = []
    insisted = 0.0
    try:
        part.reset(np.random.default_rng(7), SITUATION)
        for seen in observations(*sizes):
            before = {key: value.copy() for key, value in seen.items()}  # type: ignore[attr-defined]
            verb = "act"
            output = part.act(seen)
            for key, value in before.items():
                if not np.array_equal(seen[key], value):  # type: ignore[literal-required]
                    found[f"act changes observation[{key!r}]: work on a copy"] = None
            require_pair("act returned", output, cure)
            found |= dict.fromkeys(outputs(output))
            kept.append((output, output.copy()))
            verb = report
            said = getattr(part, report)()
            found |= dict.fromkeys(reports(said))
            if isinstance(said, Truth):
                insisted = max(insisted, insistence(said, before["twist"]))
            step += 1
    except Broken:
        raise
    except (Exception, SystemExit) as error:
        hint = access_hint(error) if isinstance(error, Exception) else ""
        raise Broken(f"{verb} fails at step {step}: {one_line(error)}{hint}") from None
    if any((now != then).any() for now, then in kept if np.isfinite(then).all()):
        found["act changes an array that it returned before: return a fresh one"] = None
    walked = np.array([then for _, then in kept])
    if report == "truth":
        found |= dict.fromkeys(faint_faults(walked, insisted))
    return walked
