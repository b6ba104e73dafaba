"""Everything that can be wrong with a scenario, found in one go."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any, TypeVar

import numpy as np
from pydantic import ValidationError

from cowalk.agents.registry import AUTOMATIONS, HUMANS, IMPERFECTIONS
from cowalk.estimation.registry import OBSERVERS, SMOOTHERS
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import Registry
from cowalk.sim.env.configuration import require_reachable
from cowalk.sim.plant.registry import PLANTS
from cowalk.sim.sensor.parameters import SensorParameters
from cowalk.sim.sensor.presets import sensor_preset
from cowalk.sim.world.contact import blocked_start

from ..trace.trace import UNITS
from .building import attempt, check_parameters, complete
from .documents import Document, Fault, KeyPath, dotted
from .human_seat import attempt_human
from .overrides import component_sections
from .schema import Component, Scenario
from .validation import validate

C = TypeVar("C", bound=Component)

REGISTRIES: dict[str, Registry[Any]] = {
    "plant": PLANTS,
    "human": HUMANS,
    "human.imperfections": IMPERFECTIONS,
    "automation": AUTOMATIONS,
    "automation.smoother": SMOOTHERS,
    "automation.observer": OBSERVERS,
}
"""Where the components of each section are looked up."""

SHARED = {
    "plant": ("rates", "gui"),
    "human": ("intention",),
    "human.imperfections": ("human",),
    "automation": ("negotiation", "smoother", "observer"),
    "automation.smoother": (),
    "automation.observer": (),
}
"""Constructor arguments that come from elsewhere in the scenario."""


def check(document: Document) -> tuple[Scenario | None, list[Fault]]:
    """Return the scenario of a document, or all of its problems."""
    if document.data is None and document.problems:
        return None, document.problems
    if not isinstance(document.data, dict):
        keys = ", ".join(name for name, item in Scenario.model_fields.items() if item.is_required())
        return None, [Fault((), f"this holds no scenario; it needs at least the keys {keys}")]
    data, unknown = _with_preset(document.data)
    scenario, problems = validate(Scenario, data)
    problems += unknown
    known = {problem.path for problem in problems}
    parts = (*_components(document.data, scenario), *_formulas(document.data, scenario))
    problems += [problem for problem in parts if problem.path not in known]
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


def _with_preset(data: dict[str, Any]) -> tuple[dict[str, Any], list[Fault]]:
    """Return the data with the sensor's preset written out beneath what is given beside it."""
    section = data.get("sensor", {})
    if section is None or section is False:  # as YAML reads "off"
        return {**data, "sensor": {}}, []
    if not isinstance(section, dict) or "preset" not in section:
        return data, []
    given = {key: value for key, value in section.items() if key != "preset"}
    named = section["preset"]
    try:
        preset = asdict(sensor_preset("none" if named in (None, False) else str(named)))
    except InputError as error:
        return {**data, "sensor": given}, [Fault(("sensor", "preset"), f"sensor.preset: {error}")]
    off = asdict(SensorParameters())
    changed = {key: value for key, value in preset.items() if value != off[key]}
    return {**data, "sensor": changed | given}, []


def resolve(scenario: Scenario) -> Scenario:
    """Return the scenario with the default parameters of its parts written out.

    A file of it gives the same run even after a default has changed.
    """

    def full(component: C, section: str) -> C:
        parameters = complete(REGISTRIES[section], component, SHARED[section])
        return component.model_copy(update={"parameters": parameters})

    seat = scenario.automation
    automation = full(seat, "automation").model_copy(
        update={
            "smoother": full(seat.smoother, "automation.smoother"),
            "observer": full(seat.observer, "automation.observer"),
        }
    )
    imperfections = tuple(
        full(item, "human.imperfections") for item in scenario.human.imperfections
    )
    human = full(scenario.human, "human").model_copy(update={"imperfections": imperfections})
    return scenario.model_copy(
        update={
            "plant": full(scenario.plant, "plant"),
            "human": human,
            "automation": automation,
        }
    )


def _components(data: dict[str, Any], scenario: Scenario | None) -> list[Fault]:
    """Return the problems of all named parts; they are built if everything around is right."""
    problems: list[Fault] = []
    for _, path, value in component_sections(data):
        section = dotted(path)
        kind = dotted(tuple(step for step in path if isinstance(step, str)))
        try:
            component = Component(name=value["name"], parameters=value.get("parameters") or {})
        except (ValidationError, TypeError, KeyError):
            continue  # reported as a fault of the schema already
        problems += check_parameters(REGISTRIES[kind], component, section, SHARED[kind])
    if not problems and scenario is not None:
        problems += _agents(scenario)
        problems += _start(scenario)
    return problems


def _start(scenario: Scenario) -> list[Fault]:
    """Return why the plant cannot be built, or why its bodies cannot stand at the start."""
    plant = attempt(PLANTS, scenario.plant, "plant", rates=scenario.rates)
    if isinstance(plant, Fault):
        return [plant]
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


def _agents(scenario: Scenario) -> list[Fault]:
    """Return why the agents cannot be built: a value that only its constructor can judge."""
    seat = scenario.automation
    shared: dict[str, Any] = {
        "negotiation": seat.negotiation,
        "smoother": attempt(SMOOTHERS, seat.smoother, "automation.smoother"),
        "observer": attempt(OBSERVERS, seat.observer, "automation.observer"),
    }
    built = (
        attempt_human(scenario.human, scenario.plant.name, scenario.rates.period),
        *shared.values(),
        attempt(AUTOMATIONS, seat, "automation", **shared),
    )
    return [part for part in built if isinstance(part, Fault)]


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


def _formulas(data: dict[str, Any], scenario: Scenario | None) -> list[Fault]:
    """Return the problems of all expectations."""
    expect = data.get("expect")
    if not isinstance(expect, dict) or not expect:
        return []
    from ..expect.verdict import syntax_error

    period = scenario.rates.period if scenario else None
    found: list[Fault] = []
    for name, formula in expect.items():
        if isinstance(formula, str) and (reason := syntax_error(formula, UNITS, period)):
            found.append(Fault(("expect", name), f"expect.{name} = {formula!r}: {reason}"))
    return found
