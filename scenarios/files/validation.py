"""Validation by pydantic, reported in words a newcomer understands."""

from __future__ import annotations

import dataclasses
import json
import math
import types
import typing
from collections.abc import Sequence
from typing import Any, TypeVar, get_args, get_origin

import yaml
from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from cowalk.sim.basics.errors import InputError, Step
from cowalk.sim.basics.registry import did_you_mean

from ..yaml_text.document import Fault, KeyPath, dotted, not_plain

M = TypeVar("M", bound=BaseModel)

RENAMED: dict[str, str] = {}
"""Keys of scenario files of earlier versions that have another name now, dotted."""
_NOUNS = {
    "float_type": "a number",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "bool_type": "true or false",
    "string_type": "text",
    "list_type": "a list",
    "tuple_type": "a list",
    "dict_type": "a section with keys of its own",
    "model_type": "a section with keys of its own",
    "dataclass_type": "a section with keys of its own",
    "none_required": "null",
}
_LIMITS = {
    "greater_than": ("above", "gt"),
    "greater_than_equal": ("at least", "ge"),
    "less_than": ("below", "lt"),
    "less_than_equal": ("at most", "le"),
}


def validate(model: type[M], data: Any, at: KeyPath = ()) -> tuple[M | None, list[Fault]]:
    """Return a validated model, or every problem of the data.

    Nothing is converted but whole numbers to numbers and lists to tuples: a quoted number, or
    a true where a number belongs, is refused.

    Parameters
    ----------
    model
        The pydantic model to validate against.
    data
        Plain data.
    at
        Where the data stand in their document.
    """
    found = {problem.path: problem for problem in not_plain(data, at)}
    validated = None
    try:
        # As JSON, because only there does strict validation take a list for a tuple.
        text = json.dumps(data, default=str)
        validated = model.model_validate_json(text, strict=True)
    except ValidationError as error:
        for details in error.errors():
            if _follows(details):
                continue
            path = _place(details, data)
            fault = _refusal(details, path, at) or Fault(
                (*at, *path), _message(details, path, at, model)
            )
            found.setdefault(fault.path, fault)
    return (None if found else validated), list(found.values())


def _follows(details: ErrorDetails) -> bool:
    """Return whether a list is called too short because entries in it are faulty."""
    short = details["type"] == "too_short"
    return short and len(details["input"]) >= details["ctx"]["min_length"]


def _place(details: ErrorDetails, data: Any) -> KeyPath:
    """Return the place of an error, without the steps that name an arm of a union."""
    path: list[Step] = []
    for position, step in enumerate(details["loc"]):
        inside_list = isinstance(data, list) and isinstance(step, int) and step < len(data)
        if inside_list or (isinstance(data, dict) and step in data):
            data = data[step]
        elif details["type"] != "missing" or position < len(details["loc"]) - 1:
            continue
        path.append(step)
    return tuple(path)


def _message(details: ErrorDetails, path: KeyPath, at: KeyPath, model: type[BaseModel]) -> str:
    key, kind, value = dotted((*at, *path)), details["type"], details["input"]
    if kind == "missing":
        too_short = ": the list is too short" if isinstance(path[-1], int) else ""
        return f"{key or 'the entry'} is missing{too_short}"
    if kind in ("extra_forbidden", "unexpected_keyword_argument"):
        if key in RENAMED:
            return f"{key} is called {RENAMED[key]} now"
        known = known_keys(model, path[:-1])
        hint = did_you_mean(str(path[-1]), known) if known else "nothing can be set here"
        return f"{key}: unknown key; {hint}"
    cure = _cure(details)
    if kind == "tuple_type" and (length := _length(model, path)):
        cure = cure.replace("a list", f"a list of {length}", 1)
    return f"{key}{equals(value)}: {cure}"


def _refusal(details: ErrorDetails, path: KeyPath, at: KeyPath) -> Fault | None:
    """Return what the check of a section, or of a single value, says: at the place it names."""
    if details["type"] != "value_error":
        return None
    said = details["ctx"]["error"]
    error = said if isinstance(said, InputError) else InputError(str(said))
    if error.at and path[-len(error.at) :] == error.at and not isinstance(details["input"], dict):
        path = path[: -len(error.at)]  # who judges a single value names it
    place = (*at, *path)
    inner = error.inside(*place) if place else error
    return Fault(inner.at, str(inner))


def equals(value: Any) -> str:
    """Return `` = value`` as YAML writes it, or nothing where that would be long."""
    text = json.dumps(value, ensure_ascii=False) if not isinstance(value, str) else repr(value)
    return f" = {text}" if len(text) <= 60 else ""


def _cure(details: ErrorDetails) -> str:
    kind, value, context = details["type"], details["input"], details.get("ctx", {})
    if kind in _NOUNS:
        return f"{_NOUNS[kind]} is expected{_instead_of(kind, value)}"
    if kind in _LIMITS:
        word, name = _LIMITS[kind]
        return f"it must be {word} {context[name]:g}"
    if kind == "string_pattern_mismatch":
        return "a run's folder is named so: it must not be empty, begin with a dot or hold a slash"
    if kind == "literal_error":
        return f"it must be {context['expected']}"
    if kind == "too_long":
        return f"the list has {len(value)} entries, it can have {context['max_length']}"
    if kind == "too_short":
        return f"the list has {len(value)} entries, it needs {context['min_length']}"
    return details["msg"].replace("Input should", "it should")


def _instead_of(kind: str, value: Any) -> str:
    if isinstance(value, str):
        try:
            number = int(value) if kind == "int_type" or value.isdecimal() else float(value)
        except ValueError:
            return ", not text"
        if kind in ("list_type", "tuple_type") or not math.isfinite(number):
            return ", not text"
        return f", not text; write {yaml.safe_dump(number).split()[0]} without quotes"
    if value is None:
        return ", nothing is given"
    quotes = "; put it in quotes" if kind == "string_type" else ""
    if isinstance(value, bool):
        return f", not true or false{quotes}"
    if isinstance(value, int | float) and quotes:
        return f", not a number{quotes}"
    return ""


def _length(hint: Any, path: Sequence[Step]) -> int | None:
    """Return how many entries the tuple at a path of an annotation has, if that is fixed."""
    if get_origin(hint) is typing.Annotated:
        return _length(get_args(hint)[0], path)
    if get_origin(hint) in (typing.Union, types.UnionType):
        return next((n for arm in get_args(hint) if (n := _length(arm, path))), None)
    if not path:
        fixed = get_origin(hint) is tuple and Ellipsis not in get_args(hint)
        return len(get_args(hint)) if fixed else None
    if isinstance(path[0], int):
        return _length(get_args(hint)[0], path[1:]) if get_args(hint) else None
    inside = _annotations(hint).get(path[0])
    return _length(inside, path[1:])


def _annotations(hint: Any) -> dict[str, Any]:
    """Return the annotations of a section's keys; none if it is no section."""
    if isinstance(hint, type) and issubclass(hint, BaseModel):
        return {item.alias or name: item.annotation for name, item in hint.model_fields.items()}
    if isinstance(hint, type) and dataclasses.is_dataclass(hint):
        hints = typing.get_type_hints(hint)
        return {item.name: hints[item.name] for item in dataclasses.fields(hint) if item.init}
    return {}


def known_keys(hint: Any, path: Sequence[Step]) -> list[str]:
    """Return the keys that the section at a path of an annotation accepts; none if any are."""
    if get_origin(hint) is typing.Annotated:
        return known_keys(get_args(hint)[0], path)
    if get_origin(hint) in (typing.Union, types.UnionType):
        arms = (known_keys(arm, path) for arm in get_args(hint))
        return next((keys for keys in arms if keys), [])
    if get_args(hint) and path and isinstance(path[0], int):
        arms_of_list = get_args(hint)
        return known_keys(arms_of_list[min(path[0], len(arms_of_list) - 1)], path[1:]) or (
            known_keys(arms_of_list[0], path[1:])
        )
    fields = _annotations(hint)
    if not path:
        return list(fields)
    return known_keys(fields.get(str(path[0])), path[1:])
