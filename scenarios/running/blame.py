"""Which part of a run has failed: named as the scenario names it."""

from __future__ import annotations

from collections.abc import Iterator
from types import TracebackType

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.basics.errors import PartError

from ..files.parts import kind_of_part
from ..files.schema import Scenario, part_of


class Blame:
    """Finds the part that an exception comes from.

    Parameters
    ----------
    scenario : Scenario
    human : Human
        As built, imperfections around it.
    automation : Automation
    """

    def __init__(self, scenario: Scenario, human: Human, automation: Automation) -> None:
        self._names: dict[int, str] = {}
        self._parts = []  # kept alive, so that an identity stays theirs
        for part, name in _named(scenario, human, automation):
            self._names[id(part)] = name
            self._parts.append(part)

    def of(self, failure: BaseException, otherwise: str) -> str:
        """Return the name of the innermost part that a failure passed through.

        Parameters
        ----------
        failure : exception
            Raised, so that it has a traceback.
        otherwise : str
            Whom to blame if it is none of the parts.
        """
        if isinstance(failure, PartError):
            return self._names.get(id(failure.part), otherwise)
        found = otherwise
        for owner in _owners(failure.__traceback__):
            found = self._names.get(id(owner), found)
        return self._called_wrongly(failure) or found

    def _called_wrongly(self, failure: BaseException) -> str | None:
        """Return whose method takes other arguments than it was given: it was never entered."""
        if not isinstance(failure, TypeError):
            return None
        method = str(failure).partition("(")[0]
        for part in reversed(self._parts):
            classes = type(part).__mro__
            if method.rpartition(".")[0] in {owner.__qualname__ for owner in classes}:
                return self._names[id(part)]
        return None


def _named(
    scenario: Scenario, human: Human, automation: Automation
) -> Iterator[tuple[object, str]]:
    for item in reversed(scenario.human.imperfections):
        yield human, f"imperfection {item.name!r}"
        human = getattr(human, "human", human)
    yield human, f"human {scenario.human.name!r}"
    yield automation, f"automation {scenario.automation.name!r}"
    for part in kind_of_part("automation").children():
        if not part.many and (made := getattr(automation, part.key, None)) is not None:
            yield made, f"{part.kind} {part_of(scenario, part.kind).name!r}"


def _owners(traceback: TracebackType | None) -> Iterator[object]:
    """Yield what ``self`` is in every frame of a traceback, outermost first."""
    while traceback is not None:
        yield traceback.tb_frame.f_locals.get("self")
        traceback = traceback.tb_next
