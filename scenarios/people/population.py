"""Populations: distributions over people, whole and drawn reproducibly."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from cowalk.agents.humans.open_loop import OpenLoopHuman
from cowalk.agents.imperfections.wrapper import Imperfection
from cowalk.agents.registry import HUMANS, IMPERFECTIONS
from cowalk.sim.basics.errors import InputError
from cowalk.sim.basics.rates import Rates
from cowalk.sim.body.gait import GaitParameters, step_frequency

from ..files.assembling import unsuited
from ..files.building import parameter_names
from ..files.schema import Scenario, human_model
from ..yaml_text.document import KeyPath
from .distribution import Distribution
from .person import Person, takes
from .sections import distributions, filled
from .traits import ArmParameters, StrengthParameters, Traits

PROBABILITY = "probability"
"""Key of an imperfection that only some people have."""
GAIT_RIPPLE = "gait-ripple"
"""The imperfection that stands for the gait where a plant has no bodies."""

_RATES = Rates()


class Group(BaseModel):
    """People who behave by one model: a human section in which any number may be drawn.

    Attributes
    ----------
    weight : float
        Share of the population, relative to the other groups.
    because : str
        The reason for the model.
    human : dict
        As in a scenario; a `Distribution` may stand for any number, and an imperfection may
        have a ``probability``.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    weight: Annotated[float, Field(gt=0.0)] = 1.0
    because: str = ""
    human: dict[str, Any]

    @cached_property
    def laws(self) -> dict[KeyPath, Distribution]:
        """Every distribution, by its path."""
        return distributions(self.human)


class Population(BaseModel):
    """A distribution over people.

    Attributes
    ----------
    name, description : str
    people : tuple of Traits
        Kinds of people, of whom one is drawn for everybody; none in a file that says nothing of
        bodies.
    groups : tuple of Group
        How they behave; a group is drawn for everybody, whatever their kind.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str
    description: str = ""
    people: tuple[Traits, ...] = ()
    groups: Annotated[tuple[Group, ...], Field(min_length=1)]

    def draw(self, count: int, seed: int = 0, plant: str = "unicycle") -> list[Person]:
        """Return people.

        Every person has a generator of their own: the first ten of a hundred are the ten that
        are drawn alone.

        Parameters
        ----------
        count : int
            Number of people.
        seed : int
        plant : str
            Plant they will walk on. One that has bodies makes a person's gait by itself; on one
            without, their ``gait-ripple`` has the same sway and cadence.

        Raises
        ------
        InputError
            If the count or the seed is negative, or the plant is not known.
        """
        if count < 0 or seed < 0:
            what = f"count = {count}" if count < 0 else f"seed = {seed}"
            raise InputError(f"{what}: must not be negative")
        has_gait = "gait" in takes(plant)
        wrappers: dict[str, Callable[..., Imperfection]] = {
            item["name"]: IMPERFECTIONS.get(item["name"])
            for group in self.groups
            for item in group.human.get("imperfections") or []
        }
        people = []
        for sequence in np.random.SeedSequence(seed).spawn(count):
            rng = np.random.default_rng(sequence)
            human = _human(_one_of(self.groups, rng), rng)
            human["imperfections"] = [
                item
                for item in human["imperfections"]
                if not unsuited(
                    wrappers[item["name"]](OpenLoopHuman(), **item.get("parameters", {})),
                    plant,
                    _RATES.period,
                )
            ]
            kind = ""
            traits: dict[str, dict[str, Any]] = {}
            if self.people:
                # Of their own, so that saying more of bodies changes nobody's mind.
                rng = np.random.default_rng(sequence.spawn(1)[0])
                chosen = _one_of(self.people, rng)
                kind, traits = chosen.kind, chosen.draw(rng)
            _strengthen(human, traits.pop("strength", {}))
            arm = traits.pop("arm", {})
            if not has_gait:
                human["imperfections"] += _ripple(traits.get("gait", {}), arm, human)
            if arm:
                traits["walker"] = {f"hand_{name}": value for name, value in arm.items()}
            people.append(Person(human_model().model_validate(human), traits, kind))
        return people


def _one_of(among: Sequence[Any], rng: np.random.Generator) -> Any:
    """Return one of several, each as likely as its weight says."""
    weights = np.cumsum([each.weight for each in among])
    return among[int(np.searchsorted(weights, rng.random() * weights[-1], side="right"))]


def _human(group: Group, rng: np.random.Generator) -> dict[str, Any]:
    """Return a human section with every distribution drawn, in the order of the file."""
    values = {path: law.at(rng.random()) for path, law in group.laws.items()}
    human = filled(group.human, values)
    present = [
        item
        for item in human.get("imperfections") or []
        if rng.random() < item.pop(PROBABILITY, 1.0)
    ]
    return human | {"imperfections": present}


def _strengthen(human: dict[str, Any], strength: dict[str, float]) -> None:
    """Give a person's strength to their model, unless their group says how strong it is."""
    if strength and "force_max" in parameter_names(HUMANS.get(human["name"])):
        most = StrengthParameters(**strength)
        human.setdefault("parameters", {}).setdefault("force_max", [most.forward, most.sideways])


def _ripple(
    gait: dict[str, Any], arm: dict[str, float], human: dict[str, Any]
) -> list[dict[str, Any]]:
    """Return the imperfection that has a person's sway, at the cadence of their own pace."""
    how = GaitParameters(**gait)
    if not how.enabled:
        return []
    usual: float = Scenario.model_fields["pace"].default
    pace = (human.get("intention") or {}).get("pace") or usual
    fore_aft, lateral = how.sway_at(pace)
    parameters = {
        "step_frequency": step_frequency(pace, how.step_frequency),
        "fore_aft_sway": fore_aft,
        "lateral_sway": lateral,
        "arm_stiffness": ArmParameters(**arm).stiffness,
    }
    return [{"name": GAIT_RIPPLE, "parameters": parameters}]
