"""Snapshots of an environment: a saved state, and why another one cannot go on from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from ..basics.errors import InputError
from .configuration import Configuration

CURE = "restore it into the environment that saved it, or one made with the same arguments"


@dataclass(frozen=True)
class Snapshot:
    """What `CowalkEnv.save` gives: opaque to users.

    Attributes
    ----------
    configuration : Configuration
        With which the environment was made.
    plant : object
        What the plant saved.
    own : mapping
        What of the environment itself changes within an episode.
    """

    configuration: Configuration
    plant: Any
    own: Mapping[str, Any]


def matching(saved: Any, configuration: Configuration) -> Snapshot:
    """Return a saved state that an environment made with some arguments can go on from.

    Raises
    ------
    InputError
        If it is none, or that of an environment made with another argument, which is named.
    """
    if not isinstance(saved, Snapshot):
        kind = type(saved).__name__
        raise InputError(f"restore takes what save of an environment gave, not a {kind}")
    for item in fields(Configuration):
        if not _same(getattr(saved.configuration, item.name), getattr(configuration, item.name)):
            raise InputError(f"restore: this state was saved with another {item.name}; {CURE}")
    return saved


def _same(one: Any, other: Any) -> bool:
    try:
        return bool(one == other)
    except ValueError:  # arrays of a plant of the user's own
        return False
