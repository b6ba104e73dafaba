"""Which part of a run has failed: named as the scenario names it."""

from __future__ import annotations

from collections.abc import Iterator
from types import TracebackType
from typing import NamedTuple

from cowalk.agents.basics.protocols import Automation, Human
from cowalk.sim.basics.errors import InputError, PartError, SimulationError, told

from ..files.parts import kind_of_part
from ..files.schema import Scenario, part_of


class Culprit(NamedTuple):
    """Who has failed.

    Attributes
    ----------
    name : str
        As the scenario names it: ``human 'escalating'``.
    part : object
    """

    name: str
    part: object

    @property
    def shipped(self) -> bool:
        """Whether it comes with cowalk."""
        return type(self.part).__module__.partition(".")[0] == "cowalk"

    def at_fault(self, failure: BaseException) -> bool:
        """Return whether a failure is a fault of cowalk's own, and not of a user's part or input.

        Parameters
        ----------
        failure : exception
            That it has failed with.
        """
        said = isinstance(failure, InputError | PartError | SimulationError)
        return self.shipped and isinstance(failure, Exception) and not said


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
        self._parts = [
            Culprit(name, part) for part, name in _named(scenario, human, automation)
        ]  # kept alive, so that an identity stays theirs
        self._known = {id(culprit.part): culprit for culprit in self._parts}

    def of(self, failure: BaseException, otherwise: Culprit) -> Culprit:
        """Return the innermost part that a failure passed through.

        Parameters
        ----------
        failure : exception
            Raised, so that it has a traceback.
        otherwise : Culprit
            Whom to blame if it is none of the parts.
        """
        if isinstance(failure, PartError):
            return self._known.get(id(failure.part), otherwise)
        found = otherwise
        for owner in _owners(failure.__traceback__):
            found = self._known.get(id(owner), found)
        return self._called_wrongly(failure) or found

    def _called_wrongly(self, failure: BaseException) -> Culprit | None:
        """Return whose method takes other arguments than it was given: it was never entered."""
        if not isinstance(failure, TypeError):
            return None
        method = told(failure).removeprefix("TypeError: ").partition("(")[0]
        for culprit in reversed(self._parts):
            classes = type(culprit.part).__mro__
            if method.rpartition(".")[0] in {owner.__qualname__ for owner in classes}:
                return culprit
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
