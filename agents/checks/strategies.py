"""What a `Strategy` must keep besides the protocol of an automation."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from cowalk.estimation.checks.rules import Kept

from ..automations.strategies.negotiation import Agreement, Negotiation
from ..automations.strategies.strategy import Strategy

SHARED = ("negotiation", "front_end", "observer", "smoother")
"""What a scenario gives to a strategy besides its own parameters."""


def constructor_faults(automation: Any) -> Iterator[str]:
    """Yield whether the constructor of a strategy loses what a scenario gives.

    Parameters
    ----------
    automation : object
        An instance, or a class; nothing is said of one that is no `Strategy`.
    """
    kind = automation if inspect.isclass(automation) else type(automation)
    if not issubclass(kind, Strategy):
        return
    parameters = inspect.signature(kind).parameters
    if any(item.kind is inspect.Parameter.VAR_KEYWORD for item in parameters.values()):
        return
    if lost := [name for name in SHARED if name not in parameters]:
        yield (
            f"its constructor does not take {', '.join(lost)}, so that a scenario's would have no "
            "effect: declare __init__(self, ..., **parts) and call super().__init__(**parts)"
        )


@contextmanager
def watched(part: Any, found: dict[str, None]) -> Iterator[None]:
    """Look at what a strategy does with what it is told while it is checked.

    Parameters
    ----------
    part : object
        Nothing is watched of one that is no `Strategy`.
    found : dict of str to None
        Faults are added here.
    """
    if not isinstance(part, Strategy):
        yield
        return
    agree, kept = part.agree, Kept()

    def watching(negotiation: Negotiation) -> Agreement:
        for name in ("own", "human", "stubbornness"):
            told = getattr(negotiation, name)
            kept.keep(f"agree changes negotiation.{name}: work on a copy", told)
        for name in ("stubbornness", "wish", "stubbornness_deviation", "wish_deviation"):
            told = getattr(negotiation.estimate, name)
            kept.keep(f"agree changes negotiation.estimate.{name}: work on a copy", told)
        return agree(negotiation)

    part.agree = watching  # type: ignore[method-assign]
    try:
        yield
    finally:
        del part.agree
    found |= dict.fromkeys(kept.faults())
