"""From a named component to an object: its parameters checked against its constructor."""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable, Collection, Mapping
from functools import lru_cache
from typing import Any, TypeVar, get_type_hints

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, create_model
from pydantic.errors import PydanticSchemaGenerationError, PydanticUserError

from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.registry import Registry

from ..yaml_text.document import Fault, KeyPath, dotted
from .schema import Component
from .validation import validate

T = TypeVar("T")

_CONFIG = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
_PLAIN = (bool, int, float, str, tuple)
_OPEN = inspect.Parameter.VAR_KEYWORD
_KEYWORDS = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


def attempt(
    registry: Registry[T],
    component: Component,
    at: KeyPath,
    shared: Mapping[str, Any],
    elsewhere: Mapping[str, str],
) -> T | Fault:
    """Return the object that a component names, or the first problem.

    Parameters
    ----------
    registry : Registry
        Where the name is looked up.
    component : Component
        Name and parameters.
    at : tuple of str and int
        Section of the scenario that holds the component, for messages.
    shared : mapping
        Arguments that come from elsewhere in the scenario (``rates``, ``smoother``, ...), by
        their names; the constructor gets those it has a parameter for.
    elsewhere : mapping of str to str
        See `check_parameters`.
    """
    constructor, parameters, problems = _prepare(registry, component, at, elsewhere)
    if problems or constructor is None:
        return problems[0]
    accepted = {name: value for name, value in shared.items() if name in _accepted(constructor)}
    try:
        return constructor(**parameters, **accepted)
    except Exception as error:  # a user's class may raise anything
        return _constructor_problem(error, component, at)


def check_parameters(
    registry: Registry[Any], component: Component, at: KeyPath, elsewhere: Mapping[str, str]
) -> list[Fault]:
    """Return every problem of a component's name and parameters, without building it.

    Parameters
    ----------
    registry, component, at
        See `attempt`.
    elsewhere : mapping of str to str
        Arguments that come from elsewhere: where in the scenario each is set, empty if nowhere.
    """
    return _prepare(registry, component, at, elsewhere)[2]


def complete(
    registry: Registry[Any], component: Component, elsewhere: Collection[str] = ()
) -> dict[str, Any]:
    """Return a component's parameters with the defaults of its constructor written out.

    Defaults that a scenario file cannot hold (objects, "none given") are left out.

    Parameters
    ----------
    registry, component, elsewhere
        See `check_parameters`.
    """
    given = dict(component.parameters)
    for name, parameter in _accepted(registry.get(component.name)).items():
        default = parameter.default
        if name in elsewhere or isinstance(default, type):
            continue
        if isinstance(default, _PLAIN):
            given.setdefault(name, default)
        elif dataclasses.is_dataclass(default) and isinstance(given.get(name, {}), Mapping):
            values = {
                item.name: getattr(default, item.name) for item in dataclasses.fields(default)
            }
            plain = {key: value for key, value in values.items() if isinstance(value, _PLAIN)}
            given[name] = plain | given.get(name, {})
    return given


def _prepare(
    registry: Registry[T], component: Component, at: KeyPath, elsewhere: Mapping[str, str]
) -> tuple[Callable[..., T] | None, dict[str, Any], list[Fault]]:
    """Return the constructor, the validated parameters and every problem of the two."""
    named: KeyPath = (*at, "name")
    try:
        constructor = registry.get(component.name)
    except InputError as error:
        return None, {}, [Fault(named, f"{dotted(named)}: {error}")]
    place: KeyPath = (*at, "parameters")
    problems = [
        Fault((*place, name), f"{dotted((*place, name))}: {_elsewhere(elsewhere[name])}")
        for name in component.parameters
        if name in elsewhere
    ]
    given = {key: value for key, value in component.parameters.items() if key not in elsewhere}
    accepts, names = _parameter_model(constructor, tuple(elsewhere))
    model, faults = validate(accepts, given, place)
    if model is None:
        return constructor, {}, [*problems, *faults]
    values = {
        names[field]: getattr(model, field) for field in names if field in model.model_fields_set
    }
    return constructor, values | (model.model_extra or {}), problems


def _elsewhere(place: str) -> str:
    return f"set this at {place}" if place else "a scenario cannot set this"


def _parameters(constructor: Callable[..., Any]) -> dict[str, inspect.Parameter]:
    """Return the parameters of a constructor; ``**kwargs`` of a class go to the class above."""
    found = dict(inspect.signature(constructor).parameters)
    for above in constructor.__mro__[1:-1] if isinstance(constructor, type) else ():
        handed_on = [name for name, item in found.items() if item.kind is _OPEN]
        if not handed_on:
            break
        if "__init__" in vars(above):
            found.pop(handed_on[0])
            found = dict(inspect.signature(above).parameters) | found
    return found


def parameter_names(constructor: Callable[..., Any]) -> list[str]:
    """Return the names of what a constructor takes by keyword."""
    return list(_accepted(constructor))


def _accepted(constructor: Callable[..., Any]) -> dict[str, inspect.Parameter]:
    parameters = _parameters(constructor)
    return {name: item for name, item in parameters.items() if item.kind in _KEYWORDS}


@lru_cache
def _parameter_model(
    constructor: Callable[..., Any], shared: tuple[str, ...]
) -> tuple[type[BaseModel], dict[str, str]]:
    """Return a model of the constructor's parameters, and which of them each field stands for.

    Fields are numbered, since a parameter may bear a name that a pydantic model cannot use.
    """
    hints = hints_of(constructor)
    try:
        return _model_of(constructor, hints, shared)
    except (PydanticSchemaGenerationError, PydanticUserError):  # for one of them at least
        checkable = {name: _checkable(hint) for name, hint in hints.items()}
        return _model_of(constructor, checkable, shared)


def _model_of(
    constructor: Callable[..., Any], hints: Mapping[str, Any], shared: tuple[str, ...]
) -> tuple[type[BaseModel], dict[str, str]]:
    fields: dict[str, Any] = {}
    names: dict[str, str] = {}
    for name, parameter in _accepted(constructor).items():
        if name in shared:
            continue
        required = parameter.default is inspect.Parameter.empty
        field = f"parameter_{len(fields)}"
        names[field] = name
        fields[field] = (
            hints.get(name, Any),
            Field(... if required else None, alias=name),
        )
    open_ended = any(item.kind is _OPEN for item in _parameters(constructor).values())
    config = _CONFIG | ConfigDict(extra="allow") if open_ended else _CONFIG
    return create_model("Parameters", __config__=config, **fields), names


def hints_of(constructor: Callable[..., Any]) -> dict[str, Any]:
    """Return the annotations of the parameters, as far as they exist at run time."""
    if not inspect.isclass(constructor):
        sources: list[Any] = [constructor]
    elif dataclasses.is_dataclass(constructor):
        # Inherited fields are annotated in the words of the module that declares them.
        sources = [constructor, constructor.__init__]
    else:
        sources = [constructor.__init__]
    hints: dict[str, Any] = {}
    for source in sources:
        hints = _hints_of(source) | hints
    known = inspect.signature(constructor).parameters
    for above in constructor.__mro__[1:-1] if isinstance(constructor, type) else ():
        more = _hints_of(above.__init__)  # type: ignore[misc] # of what **kwargs hand on
        hints = {name: hint for name, hint in more.items() if name not in known} | hints
    return hints


def _hints_of(source: Any) -> dict[str, Any]:
    try:
        return get_type_hints(source, include_extras=True)
    except (NameError, TypeError, AttributeError):
        return {}  # annotated for the type checker alone; the names still count


def _checkable(hint: Any) -> Any:
    """Return an annotation, or `Any` where pydantic cannot check it."""
    try:
        TypeAdapter(list[hint], config=ConfigDict(arbitrary_types_allowed=True))
    except (PydanticSchemaGenerationError, PydanticUserError):
        return Any
    return hint


def _constructor_problem(error: Exception, component: Component, at: KeyPath) -> Fault:
    """Return why a constructor refused, at the parameter that it blames."""
    place: KeyPath = (*at, "parameters")
    if isinstance(error, InputError):
        refused = error.inside(*place)
        return Fault(refused.at, str(refused))
    if isinstance(error, ValueError):
        return Fault(place, f"{dotted(place)}: {error}")
    named: KeyPath = (*at, "name")
    reason = f"it cannot be built: {type(error).__name__}: {error}"
    return Fault(named, f"{dotted(named)} = {component.name!r}: {reason}")
