"""Parameters given as their dataclass, as plain data from a file, or not at all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, TypeVar

from .errors import InputError
from .registry import did_you_mean
from .validators import refusal, shown

P = TypeVar("P")


def parameters(name: str, kind: type[P], given: Any) -> P:
    """Return parameters as their dataclass.

    Parameters
    ----------
    name : str
        What messages call them.
    kind : type
        The dataclass.
    given : dataclass, mapping or None

    Raises
    ------
    InputError
        If it is neither, a key is unknown or missing, or a value refused.
    """
    if given is None:
        return kind()
    if isinstance(given, kind):
        return given
    items = [field for field in fields(kind) if field.init]  # type: ignore[arg-type]
    known = [field.name for field in items]
    if not isinstance(given, Mapping):
        what = f"give a mapping or {kind.__name__} of {', '.join(known)}"
        raise refusal(name, given, what)
    if unknown := [key for key in given if key not in known]:
        near = did_you_mean(str(unknown[0]), known)
        at = (name, unknown[0] if isinstance(unknown[0], str | int) else shown(unknown[0]))
        raise InputError(f"{name}.{at[1]}: unknown key; {near}", at)
    try:
        return kind(**given)
    except InputError as error:
        raise error.inside(name) from error
