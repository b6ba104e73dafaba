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

from cowalk.sim.errors import InputError
from cowalk.sim.motion import Array

from .check_rules import (
    SITUATION,
    Broken,
    belief_faults,
    force_faults,
    observations,
    require_pair,
    truth_faults,
    twist_faults,
)
from .interfaces import Observation

_OUTPUT = {
    "human": "return the hand force on the base in N, np.array([fx, fy])",
    "automation": "return the twist in m/s and rad/s, np.array([v, omega])",
}


def check_human(human: Any) -> None:
    """Check that an object keeps the protocol `Human`.

    It is walked for 8 s beside a made-up base that turns and pushes. Checked are: shapes,
    finite and plausible forces, truth within [0, 1], repetition after a reset with an equal
    generator, global random state and observations left alone, and a force that answers the
    base's motion, the measured force being the same, unless the class says
    ``closed_loop = False``.

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
        except Exception as error:
            return [f"it cannot be built without arguments ({error}): check an instance of it"]
    methods = {
        "reset": "reset(self, rng, situation)",
        "act": f"act(self, observation), to {_OUTPUT[seat]}",
        report: f"{report}(self), to return a {report.capitalize()}",
    }
    problems = [
        f"there is no method {name!r}: add {how}"
        for name, how in methods.items()
        if not callable(getattr(part, name, None))
    ]
    if problems:
        return problems
    states = _global_states()
    found: dict[str, None] = {}  # each fault once, in order
    try:
        first, again = (
            _walk(part, seat, report, (1.0, 1.0), outputs, reports, found) for _ in range(2)
        )
        # A human must answer how the base moves; an automation may answer the push alone.
        other = (0.3, 1.0 if seat == "human" else 0.3)
        calmer = _walk(part, seat, report, other, outputs, reports, found)
    except Broken as error:
        return [*found, str(error)]
    problems = list(found)
    if _global_states() != states:
        problems.append(
            "it touches the global random state: draw from the rng that reset is given alone"
        )
    different = np.flatnonzero((first != again).any(axis=-1))
    if different.size:
        problems.append(
            f"two walks after resets with equal generators differ from step {different[0]} on: set "
            "all state in reset, and draw only from the rng that reset is given"
        )
    elif not problems:
        problems += _loop_faults(part, seat, bool((first != calmer).any()))
    return problems


def _loop_faults(part: Any, seat: str, answers: bool) -> Iterator[str]:
    output = "force" if seat == "human" else "twist"
    felt, motion = ("", "'s twist or pose") if seat == "human" else (" and is pushed", "")
    if getattr(part, "closed_loop", True) and not answers:
        yield (
            f"its {output} is the same however the base moves{felt}: use the observation"
            f"{motion}, or say closed_loop = False in the class"
        )
    elif not getattr(part, "closed_loop", True) and answers:
        yield f"it says closed_loop = False, yet its {output} answers the base: leave that out"


def _global_states() -> bytes:
    legacy = np.random.get_state()  # noqa: NPY002 - the global state is what is watched
    return pickle.dumps((legacy, random.getstate()))


def _walk(
    part: Any,
    seat: str,
    report: str,
    sizes: tuple[float, float],
    outputs: Faults,
    reports: Faults,
    found: dict[str, None],
) -> Array:
    """Step a part through one walk; return outputs, and note every fault.

    ``sizes`` scale how much the base moves to and fro, and how hard it is pushed.
    """
    step, verb = 0, "reset"
    kept: list[tuple[Array, Array]] = []
    try:
        part.reset(np.random.default_rng(7), SITUATION)
        for seen in observations(*sizes):
            before = {key: value.copy() for key, value in seen.items()}  # type: ignore[attr-defined]
            verb = "act"
            output = part.act(seen)
            for key, value in before.items():
                if not np.array_equal(seen[key], value):  # type: ignore[literal-required]
                    found[f"act changes observation[{key!r}]: work on a copy"] = None
            require_pair("act returned", output, _OUTPUT[seat])
            found |= dict.fromkeys(outputs(output))
            kept.append((output, output.copy()))
            verb = report
            found |= dict.fromkeys(reports(getattr(part, report)()))
            step += 1
    except Broken:
        raise
    except Exception as error:
        keys = f"; an observation has the keys {', '.join(Observation.__annotations__)}"
        hint = keys if isinstance(error, KeyError) else ""
        raise Broken(
            f"{verb} fails at step {step}: {type(error).__name__}: {error}{hint}"
        ) from None
    if any((now != then).any() for now, then in kept if np.isfinite(then).all()):
        found["act changes an array that it returned before: return a fresh one"] = None
    return np.array([then for _, then in kept])
