"""From names on the command line to the pictures of humans and imperfections."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from cowalk.agents.imperfections.wrapper import Imperfection
from cowalk.sim.basics.errors import InputError

from ..export.folder import writable_folder
from ..figures.humans import draw_human, draw_imperfection
from ..files.assembling import build_human
from ..files.overrides import OverrideError, expand_names, override
from ..files.schema import HumanComponent, human_model
from ..files.validation import validate
from ..people.responses import SITUATION, answer, draws, push

PLANT = "unicycle"
DURATION, FORCE = 12.0, 5.0
"""The push that shows an open-loop human without a profile, s and N."""
RUNS = 3
"""Runs of an imperfection that draws, of which one is drawn boldly."""


def human_section(
    name: str, imperfections: Sequence[str] = (), assignments: Sequence[str] = ()
) -> HumanComponent:
    """Return the human section that names and ``human.key=VALUE`` assignments describe.

    Raises
    ------
    InputError
        If something in it is not right: the first fault.
    """
    data = {"human": {"name": name, "imperfections": list(imperfections)}}
    expand_names(data)
    for number, assignment in enumerate(assignments):
        change = override(data, assignment, number)
        expand_names(data)
        if change.path[0] != "human":
            raise OverrideError(assignment, "only keys of human can be set here", number)
        if data["human"]["name"] != name:
            other = (
                f"the model is named as the argument; cowalk humans show {data['human']['name']}"
            )
            raise OverrideError(assignment, other, number)
    component, problems = validate(human_model(), data["human"], ("human",))
    if component is None:
        raise problems[0].error()
    return component


def show_human(
    name: str, imperfections: Sequence[str], assignments: Sequence[str], file: Path
) -> dict[str, list[float]]:
    """Write the picture of a human model, and return its fixed points in v and in omega.

    Parameters
    ----------
    name : str
        Registered name or ``module:Class``.
    imperfections : sequence of str
        Names, the innermost first.
    assignments : sequence of str
        ``human.key=VALUE``.
    file : Path
        PNG.

    Raises
    ------
    InputError
        If a name, a value or the file is not right.
    """
    component = human_section(name, imperfections, assignments)
    title = f"human {name}"
    if name == "open-loop" and "profile" not in component.parameters:
        shown = {"profile": push(DURATION, FORCE, forward=True)} | component.parameters
        component = component.model_copy(update={"parameters": shown})
        title += " on a push made up for this picture"
    human = build_human(component, PLANT, SITUATION.period)
    bare = None
    if component.imperfections:
        without = component.model_copy(update={"imperfections": ()})
        bare = build_human(without, PLANT, SITUATION.period)
        title += f" with {_listed(component)}; in grey without"
    writable_folder(file.parent)
    return draw_human(human, bare, title, file)


def show_imperfections(
    imperfections: Sequence[str], assignments: Sequence[str], file: Path
) -> float:
    """Write the picture of imperfections alone, and return the largest change in N.

    Parameters
    ----------
    imperfections, assignments, file
        See `show_human`.

    Raises
    ------
    InputError
        If a name, a value or the file is not right.
    """
    component = human_section("open-loop", imperfections, assignments)
    hand = build_human(component, PLANT, SITUATION.period)
    if not isinstance(hand, Imperfection):
        raise InputError("no imperfection is left to show")
    duration, force = hand.demonstration
    profile = push(duration, force)
    pushing = component.model_copy(update={"parameters": {"profile": profile}})
    hand = build_human(pushing, PLANT, SITUATION.period)
    seeds = range(RUNS if draws(hand) else 1)
    given = [answer(hand, 0.0, duration, seed=seed).force for seed in seeds]
    asked = np.array(profile)[:, 1:]
    writable_folder(file.parent)
    title = _listed(component)
    if len(given) > 1:
        title += f"; thin: {len(given) - 1} other seeds"
    draw_imperfection(np.array(profile)[:, 0], asked, given, title, file)
    return float(np.abs(given[0] - asked).max())


def _listed(component: HumanComponent) -> str:
    return ", ".join(item.name for item in component.imperfections)
