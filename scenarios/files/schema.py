"""What a scenario file may hold: one model a section, validated once, at the door."""

from __future__ import annotations

from functools import lru_cache
from typing import Annotated, Any, cast

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, create_model

from cowalk.agents.automations.planner.settings import NegotiationSettings
from cowalk.agents.humans.intention.intention import IntentionSettings
from cowalk.sim.basics.motion import TwistBounds
from cowalk.sim.basics.own_modules import folders, look_in
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.registry import import_address
from cowalk.sim.basics.validators import require, require_range
from cowalk.sim.env.configuration import RANGES, STARTS
from cowalk.sim.env.reward import RewardParameters
from cowalk.sim.sensor.parameters import SensorParameters
from cowalk.sim.world.world import World

from .parts import Part, kind_of_part, parts

# A file is validated against models made of these: most are never built themselves.
_CONFIG = ConfigDict(extra="forbid", frozen=True, defer_build=True)


LONGEST_NAME = 200
"""Characters of the name of a part, of whichever module."""


def _within(name: str) -> AfterValidator:
    """Return what refuses a number that no environment can be made with."""

    def judged(value: float) -> float:
        require_range(name, value, RANGES[name])
        return value

    return AfterValidator(judged)


def _known_start(value: str) -> str:
    """Refuse a start that no environment can be made with."""
    require(value in STARTS, "start", value, f"must be one of {', '.join(STARTS)}")
    return value


class Component(BaseModel):
    """A replaceable part: its registered name or ``module:Class``, and its parameters.

    A file may give the name alone, ``human: steady`` for ``human: {name: steady}``.
    """

    model_config = _CONFIG

    name: Annotated[str, Field(max_length=LONGEST_NAME)]
    parameters: dict[str, Any] = Field(default_factory=dict)


class HumanComponent(Component):
    """The human seat. ``intention`` and ``imperfections`` stay when the model is swapped.

    The first imperfection is the innermost: it acts on what the model asks for, the next one
    on what the first leaves of it.
    """

    intention: IntentionSettings = Field(default_factory=IntentionSettings)
    imperfections: tuple[Component, ...] = ()


class AutomationComponent(Component):
    """The automation seat. What it shares with others stays when the strategy is swapped."""

    negotiation: NegotiationSettings = Field(default_factory=NegotiationSettings)


class Scenario(BaseModel):
    """A whole scenario. Lengths in m, times in s, angles in rad, forces in N.

    What a file is validated against is made of this and the table of parts, `scenario_model`;
    a part without an attribute here is reached by `part_of`.
    """

    model_config = _CONFIG

    name: Annotated[str, Field(pattern=r"^[^./\n\t][^/\n\t]*$", max_length=100)]
    description: str = ""
    seed: Annotated[int, Field(ge=0)] = 0
    duration: Annotated[float, _within("duration")] = 30.0
    pace: Annotated[float, _within("pace")] = 0.8
    plant: Component = Component(name="bullet")
    rates: Rates = Rates()
    world: World
    sensor: SensorParameters = SensorParameters()
    bounds: TwistBounds = TwistBounds()
    force_limit: Annotated[float, _within("force_limit")] = 30.0
    reward: RewardParameters = RewardParameters()
    start: Annotated[str, AfterValidator(_known_start)] = "pace"
    human: HumanComponent
    automation: AutomationComponent
    expect: dict[str, str] = Field(default_factory=dict)

    def __getstate__(self) -> dict[Any, Any]:
        """Return the state; another process shall find the classes that it names."""
        return super().__getstate__() | {"folders": folders()}

    def __setstate__(self, state: dict[Any, Any]) -> None:
        """Take a state over, and look for classes where it did."""
        for folder in reversed(state.pop("folders")):
            look_in(folder)
        super().__setstate__(state)


def scenario_model() -> type[Scenario]:
    """Return the model of a whole scenario file: `Scenario` and every row of the table."""
    return cast("type[Scenario]", _models(parts())[()])


def section_model(part: Part) -> type[Component]:
    """Return the model of the section of a part, with the parts beneath it."""
    return cast("type[Component]", _models(parts())[part.section])


def human_model() -> type[HumanComponent]:
    """Return the model of the human section."""
    return cast("type[HumanComponent]", section_model(kind_of_part("human")))


@lru_cache
def _models(table: tuple[Part, ...]) -> dict[tuple[str, ...], type[Any]]:
    """Return the model of every section, and of the whole by the empty path."""
    made: dict[tuple[str, ...], type[Any]] = {}
    for part in reversed(table):  # what is held comes after what holds it
        made[part.section] = _with_children(import_address(part.model), part.section, table, made)
    made[()] = _with_children(Scenario, (), table, made)
    return made


def _with_children(
    base: type[Any],
    section: tuple[str, ...],
    table: tuple[Part, ...],
    made: dict[tuple[str, ...], type[Any]],
) -> type[Any]:
    """Return a model with a field for every kind of part beneath a section."""
    fields: dict[str, Any] = {}
    for part in table:
        if part.section[:-1] != section or len(part.section) != len(section) + 1:
            continue
        model = made[part.section]
        if part.many:
            fields[part.key] = (tuple[model, ...], ())  # type: ignore[valid-type]
        elif part.preset:
            fields[part.key] = (model, model())
        else:
            default = model(name=part.default) if part.default else ...
            fields[part.key] = (model, default)
    there = base.model_fields if fields else {}
    if all(key in there and there[key].annotation == fields[key][0] for key in fields):
        return base
    return create_model(_PREFIX + base.__name__, __base__=base, __module__=__name__, **fields)


_PREFIX = "Full"


def __getattr__(name: str) -> Any:
    """Return a model made from the table by its name: what a pickled scenario asks for."""
    if name.startswith(_PREFIX):
        for model in _models(parts()).values():
            if model.__name__ == name:
                return model
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def part_of(scenario: Scenario, kind: str) -> Component:
    """Return the part of a kind that a scenario names.

    Parameters
    ----------
    scenario : Scenario
    kind : str
        As in the table, ``"smoother"`` for one; none that comes in lists.
    """
    found: Any = scenario
    for step in kind_of_part(kind).section:
        found = getattr(found, step)
    return cast("Component", found)


def with_part(scenario: Scenario, kind: str, part: Component) -> Scenario:
    """Return a scenario with one of its parts replaced.

    Parameters
    ----------
    scenario, kind
        See `part_of`.
    part : Component
        The whole section.
    """

    def replaced(holder: Any, steps: tuple[str, ...]) -> Any:
        inner = replaced(getattr(holder, steps[0]), steps[1:]) if steps[1:] else part
        return holder.model_copy(update={steps[0]: inner})

    return cast("Scenario", replaced(scenario, kind_of_part(kind).section))


def with_named(scenario: Scenario, kind: str, name: str) -> Scenario:
    """Return a scenario with one of its parts swapped; named again, the part stays as it is.

    A swap drops the ``parameters`` and keeps the rest of the section.

    Parameters
    ----------
    scenario, kind
        See `part_of`.
    name : str
        Registered name or ``module:Class``.
    """
    part = part_of(scenario, kind)
    if part.name == name:
        return scenario
    return with_part(scenario, kind, part.model_copy(update={"name": name, "parameters": {}}))
