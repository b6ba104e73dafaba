"""Checks for classes of your own: whether a human or an automation keeps its protocol.

``check_human(MyHuman())`` raises one `InputError` that lists every fault with its cure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from cowalk.estimation.checks.rules import (
    RETURNED,
    Kept,
    Methods,
    attempt,
    column_faults,
    generator_faults,
    problems_of,
    raise_problems,
    repeat_faults,
)
from cowalk.estimation.checks.stream import SITUATION
from cowalk.sim.basics.motion import Array

from ..basics.protocols import Truth
from ..imperfections.wrapper import Imperfection
from .rules import (
    access_hint,
    belief_faults,
    faint_faults,
    force_faults,
    insisted,
    law_faults,
    require_pair,
    stated,
    truth_faults,
    twist_faults,
)
from .strategies import constructor_faults, watched
from .walk import observations

_ANSWERS = 1e-3
"""Least difference of a force in N, or of a twist in m/s or rad/s, that counts as an answer."""
_WALK = (1.0, 1.0)
_OUTPUT = {
    "human": "return the hand force on the base in N, np.array([fx, fy])",
    "automation": "return the twist in m/s and rad/s, np.array([v, omega])",
}


def check_human(human: Any) -> None:
    """Check that an object keeps the protocol `Human`.

    It is walked for 8 s beside a made-up base that sets off from rest, turns, pushes, halts,
    loses samples, and passes obstacles. Checked are: signatures, shapes, finite and plausible
    forces, a wish within the bounds, stubbornness within [0, 1] and behind the force where strength
    and gain are stated, repetition after a reset with an equal generator, another
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
    raise_problems(human, human_problems(human))


def check_automation(automation: Any) -> None:
    """Check that an object keeps the protocol `Automation`.

    As `check_human`; the twist must lie within the situation's bounds and answer the base's
    motion or the measured force, the belief must lie within its ranges, and what it adds to the
    trace must be declared in ``columns``. A `Strategy` must return an `Agreement`, leave the
    `Negotiation` alone, and take from a scenario what it is to negotiate with.

    Parameters
    ----------
    automation : object
        An instance, or a class that can be built without arguments.

    Raises
    ------
    InputError
        If something is not right: all faults, each with its cure.
    """
    raise_problems(automation, automation_problems(automation))


def human_problems(human: Any) -> list[str]:
    """Return every fault that `check_human` finds, each with its cure."""
    # A human must answer how the base moves, however they are pushed.
    seat = _Seat("human", "truth", (0.3, 1.0), force_faults, lambda part: truth_faults)
    return problems_of(human, _methods(seat), partial(_examine, seat=seat))


def automation_problems(automation: Any) -> list[str]:
    """Return every fault that `check_automation` finds, each with its cure."""
    seat = _Seat("automation", "belief", (0.3, 0.3), twist_faults, _beliefs)
    found = problems_of(automation, _methods(seat), partial(_examine, seat=seat))
    return [*constructor_faults(automation), *found]


def _beliefs(part: Any) -> Faults:
    return partial(belief_faults, columns=getattr(part, "columns", {}))


Faults = Callable[[Any], Iterator[str]]


class _Seat(NamedTuple):
    """What is expected in a seat: what it reports, and what is wrong with what it answers.

    ``calm`` scales the walk that its output must answer: swing and push.
    """

    name: str
    report: str
    calm: tuple[float, float]
    outputs: Faults
    reports: Callable[[Any], Faults]


def _methods(seat: _Seat) -> Methods:
    return {
        "reset": (("rng", "situation"), "reset(self, rng, situation)"),
        "act": (("observation",), f"act(self, observation), to {_OUTPUT[seat.name]}"),
        seat.report: ((), f"{seat.report}(self), to return a {seat.report.capitalize()}"),
    }


def _examine(part: Any, seat: _Seat) -> Iterator[str]:
    """Yield the faults of a part that has the methods of its seat."""
    automation = seat.report == "belief"
    found = dict.fromkeys(column_faults(getattr(part, "columns", {})) if automation else ())
    with watched(part, found):
        # The first walk once more at the end: a class may count its resets.
        walks = [_walk(part, seat, sizes, found) for sizes in (_WALK, _WALK, seat.calm, _WALK)]
        found |= dict.fromkeys(generator_faults(part, partial(_reset, part), "the same person"))
    first, again, calmer, last = walks
    cure = "set all state in reset, and draw only from the rng that reset is given"
    what = "two walks after resets with equal generators"
    found |= dict.fromkeys(repeat_faults(first, [again, last], what, cure))
    yield from found
    if not found:
        yield from _loop_faults(part, seat.name, float(np.abs(first - calmer).max()))


def _reset(part: Any, seed: int) -> None:
    part.reset(np.random.default_rng(seed), SITUATION)


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


def _walk(part: Any, seat: _Seat, sizes: tuple[float, float], found: dict[str, None]) -> Array:
    """Step a part through one walk; return outputs, and note every fault.

    ``sizes`` scale how much the base moves to and fro, and how hard it is pushed.
    """
    kept, out = Kept(), []
    most, meant, delay = 0.0, [], 0.0
    reports, report = seat.reports(part), seat.report
    attempt("reset fails at step 0", _reset, part, 7)
    for step, seen in enumerate(observations(*sizes)):
        twist = seen["twist"].copy()
        for key, value in seen.items():
            kept.keep(f"act changes observation[{key!r}]: work on a copy", value)  # type: ignore[arg-type]
        output = attempt(f"act fails at step {step}", part.act, seen, hint=access_hint)
        require_pair("act returned", output, _OUTPUT[seat.name])
        found |= dict.fromkeys(seat.outputs(output))
        kept.keep(f"act {RETURNED}", output)
        out.append(output.copy())
        said = attempt(f"{report} fails at step {step}", getattr(part, report), hint=access_hint)
        found |= dict.fromkeys(reports(said))
        if isinstance(said, Truth):
            most = max(most, insisted(said, twist))
            meant.append(stated(said, twist))
            delay = float(said.delay) / SITUATION.period
    found |= dict.fromkeys(kept.faults())
    walked = np.array(out)
    if report == "truth":
        found |= dict.fromkeys(faint_faults(walked, most))
        if not isinstance(part, Imperfection):  # which changes the force, and not the truth
            found |= dict.fromkeys(law_faults(walked, np.array(meant), delay))
    return walked
