"""Parameters given as their dataclass, as plain data from a file, or not at all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, TypeVar

from .errors import InputError
from .registry import did_you_mean

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
        If a key is unknown or a value refused.
    """
    if given is None:
        return kind()
    if not isinstance(given, Mapping):
        return given  # type: ignore[no-any-return]
    known = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    if unknown := [key for key in given if key not in known]:
        raise InputError(f"{name}.{unknown[0]}: unknown key; {did_you_mean(unknown[0], known)}")
    values = {key: tuple(v) if isinstance(v, list) else v for key, v in given.items()}
    try:
        return kind(**values)
    except InputError as error:
        raise InputError(f"{name}.{error}") from error
