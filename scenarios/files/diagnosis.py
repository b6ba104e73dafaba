"""Everything that can be wrong with a scenario, found in one go."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any, cast

import numpy as np
from pydantic import ValidationError

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import Registry
from cowalk.sim.env.configuration import require_reachable
from cowalk.sim.plant.protocol import Plant
from cowalk.sim.world.contact import blocked_start

from ..trace.columns import UNITS, all_columns
from ..yaml_text.document import Document, Fault, KeyPath, dotted
from .assembling import assemble, elsewhere, surroundings
from .building import check_parameters
from .overrides import sections
from .parts import Part, parts, roots
from .schema import LONGEST_NAME, Component, Scenario, scenario_model, section_model
from .validation import validate

UNHURRIED = 10.0
"""Up to which a negotiation, or what it averages, may be longer than the run, s: whoever tries a
scenario for a second need not change it (inferred)."""


def check(document: Document) -> tuple[Scenario | None, list[Fault]]:
    """Return the scenario of a document, or all of its problems."""
    if document.data is None and document.problems:
        return None, document.problems
    if not isinstance(document.data, dict):
        fields = scenario_model().model_fields.items()
        keys = ", ".join(name for name, item in fields if item.is_required())
        return None, [Fault((), f"this holds no scenario; it needs at least the keys {keys}")]
    data, unknown = document.data, []
    for part in parts():
        if part.preset:
            data, faults = _with_preset(part, data)
            unknown += faults
    scenario, problems = validate(scenario_model(), data)
    problems += unknown
    known = {problem.path for problem in problems}
    columns = dict(UNITS)
    inner = _components(document.data, scenario, columns)
    inner += _formulas(document.data, scenario, columns)
    problems += [problem for problem in inner if problem.path not in known]
    problems += document.problems
    if scenario is not None:
        try:
            scenario.automation.negotiation.steps(scenario.rates.period)
        except InputError as error:
            problems.append(Fault(("automation", "negotiation", "period"), str(error)))
        try:
            require_reachable(scenario.pace, scenario.bounds)
        except InputError as error:
            problems.append(Fault(("pace",), str(error)))
        problems += _too_late(scenario)
        problems += _never_come(scenario)
    return scenario, problems


def _with_preset(part: Part, data: dict[str, Any]) -> tuple[dict[str, Any], list[Fault]]:
    """Return the data with a preset written out beneath what is given beside it."""
    section = data.get(part.key, {})
    if section is None or section is False:  # as YAML reads "off"
        return {**data, part.key: {}}, []
    if not isinstance(section, dict) or part.named_by not in section:
        return data, []
    given = {key: value for key, value in section.items() if key != part.named_by}
    named = section[part.named_by]
    at: KeyPath = (part.key, part.named_by)
    if isinstance(named, str) and len(named) > LONGEST_NAME:
        what = f"{dotted(at)}: a name has at most {LONGEST_NAME} characters"
        return {**data, part.key: given}, [Fault(at, what)]
    try:
        preset = asdict(part.registry().get("none" if named in (None, False) else str(named)))
    except InputError as error:
        return {**data, part.key: given}, [Fault(at, f"{dotted(at)}: {error}")]
    off = asdict(cast(Any, section_model(part))())
    changed = {key: value for key, value in preset.items() if value != off[key]}
    return {**data, part.key: changed | given}, []


def _components(
    data: dict[str, Any], scenario: Scenario | None, columns: dict[str, str]
) -> list[Fault]:
    """Return the problems of all named parts; they are built if everything around is right.

    What an automation adds to the trace is added to ``columns``.
    """
    problems: list[Fault] = []
    for part, _, path, value in sections(data):
        if part.preset:
            continue
        try:
            component = Component(name=value["name"], parameters=value.get("parameters") or {})
        except (ValidationError, TypeError, KeyError):
            continue  # reported as a fault of the schema already
        registry = cast("Registry[Any]", part.registry())
        problems += check_parameters(registry, component, path, elsewhere(part, path))
    if not problems and scenario is not None:
        around = surroundings(scenario)
        for part in roots():
            component = getattr(scenario, part.key)
            made = assemble(part, component, around, part.section, problems)
            if part.kind == "plant" and made is not None:
                problems += _start(scenario, made)
            if part.kind != "automation":  # `columns` of a recorded human are its file's
                continue
            try:
                columns |= all_columns(getattr(made, "columns", {}))
            except InputError as error:
                problems.append(Fault((*part.section, "name"), f"{dotted(part.section)}: {error}"))
    return problems


def _start(scenario: Scenario, plant: Plant) -> list[Fault]:
    """Return why the bodies of a plant cannot stand at the start; it is closed."""
    world = scenario.world
    try:
        state = plant.reset(world, np.random.default_rng(scenario.seed))
        if not plant.distances(world)(0.0, *state.poses)[1]:
            return []
        reason = blocked_start(world, plant.bodies, state.poses, plant.distances)
        return [Fault(("world", "start"), reason)]
    except Exception as error:  # a user's class may raise anything
        reason = f"it cannot be started: {type(error).__name__}: {error}"
        return [Fault(("plant", "name"), f"plant.name = {scenario.plant.name!r}: {reason}")]
    finally:
        plant.close()


def _too_late(scenario: Scenario) -> list[Fault]:
    """Return what takes as long as the run, so that it would be over before."""
    drive = scenario.plant.parameters.get("drive")
    delays: list[tuple[KeyPath, Any]] = [
        (("sensor", "latency"), scenario.sensor.latency),
        (("plant", "parameters", "drive", "delay"), isinstance(drive, dict) and drive.get("delay")),
    ]
    for index, item in enumerate(scenario.human.imperfections):
        path = ("human", "imperfections", index, "parameters", "delay")
        delays.append((path, item.parameters.get("delay")))
    run = f"the run, duration = {scenario.duration:g} s"
    found = [
        Fault(path, f"{dotted(path)} = {delay:g} s: must be shorter than {run}")
        for path, delay in delays
        if isinstance(delay, int | float) and delay >= scenario.duration
    ]
    negotiation = scenario.automation.negotiation
    for key in ("period", "force_window"):
        value = getattr(negotiation, key)
        if value > max(scenario.duration, UNHURRIED):
            at: KeyPath = ("automation", "negotiation", key)
            found.append(Fault(at, f"{dotted(at)} = {value:g} s: must not be longer than {run}"))
    rate = scenario.sensor.rate
    if 0.0 < rate * scenario.duration <= 1.0:
        what = f"sensor.rate = {rate:g} Hz: must convert more than once in {run}"
        found.append(Fault(("sensor", "rate"), what))
    return found


def _never_come(scenario: Scenario) -> list[Fault]:
    """Return which changes of mind come after the run's end, or ask for more than its bounds."""
    duration, length = scenario.duration, scenario.world.path.length
    fastest = scenario.bounds.upper[0]
    after, behind = np.nextafter((duration, length), 0.0)  # to come then is to come never
    limits = {
        "at_time": (after, f"s: must come before the run is over, duration = {duration:g} s"),
        "at_station": (behind, f"m: must lie before the end of world.path, {length:g} m"),
        "pace": (fastest, f"m/s: must not be above the upper bound of v, {fastest:g} m/s"),
    }
    found: list[Fault] = []
    for index, change in enumerate(scenario.human.intention.changes):
        for key, (most, what) in limits.items():
            value = getattr(change, key)
            if value is not None and value > most:
                path: KeyPath = ("human", "intention", "changes", index, key)
                found.append(Fault(path, f"{dotted(path)} = {value:g} {what}"))
    return found


def _formulas(
    data: dict[str, Any], scenario: Scenario | None, columns: dict[str, str]
) -> list[Fault]:
    """Return the problems of all expectations."""
    expect = data.get("expect")
    if not isinstance(expect, dict) or not expect:
        return []
    from ..expect.verdict import syntax_error

    timing = (scenario.rates.period, scenario.duration) if scenario else ()
    found: list[Fault] = []
    for name, formula in expect.items():
        if isinstance(formula, str) and (reason := syntax_error(formula, columns, *timing)):
            shown = repr(formula) if len(formula) <= _SHOWN else f"{formula[:_SHOWN]!r}..."
            found.append(Fault(("expect", name), f"expect.{name} = {shown}: {reason}"))
    return found


_SHOWN = 300
"""Characters of a formula in a message."""
