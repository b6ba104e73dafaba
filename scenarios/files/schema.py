"""What a scenario file may hold: one model a section, validated once, at the door."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from cowalk.agents.automations.planner.settings import NegotiationSettings
from cowalk.agents.humans.intention.intention import IntentionSettings
from cowalk.sim.basics.motion import TwistBounds
from cowalk.sim.basics.rates import Rates
from cowalk.sim.basics.validators import require_range
from cowalk.sim.env.configuration import RANGES
from cowalk.sim.env.reward import RewardParameters
from cowalk.sim.sensor.parameters import SensorParameters
from cowalk.sim.world.world import World

SUFFIX = ".scenario.yaml"
"""How the name of a scenario file ends."""


def _within(name: str) -> AfterValidator:
    """Return what refuses a number that no environment can be made with."""

    def judged(value: float) -> float:
        require_range(name, value, RANGES[name])
        return value

    return AfterValidator(judged)


class Component(BaseModel):
    """A replaceable part: its registered name or ``module:Class``, and its parameters.

    A file may give the name alone, ``human: steady`` for ``human: {name: steady}``.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str
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
    smoother: Component = Component(name="moving-average")
    observer: Component = Component(name="paper")


class Scenario(BaseModel):
    """A whole scenario. Lengths in m, times in s, angles in rad, forces in N."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: Annotated[str, Field(pattern=r"^[^./][^/]*$")]
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
    human: HumanComponent
    automation: AutomationComponent
    expect: dict[str, str] = Field(default_factory=dict)
