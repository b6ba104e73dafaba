"""The human models, their imperfections and the automations that ship, by name."""

from __future__ import annotations

from cowalk.sim.basics.registry import Registry

from .basics.protocols import Automation, Human
from .imperfections.wrapper import Imperfection

HUMANS: Registry[Human] = Registry(
    "human",
    {
        "open-loop": "cowalk.agents.humans.open_loop:OpenLoopHuman",
        "steady": "cowalk.agents.humans.steady:SteadyHuman",
        "escalating": "cowalk.agents.humans.escalating:EscalatingHuman",
        "conceding": "cowalk.agents.humans.conceding:ConcedingHuman",
        "tit-for-tat": "cowalk.agents.humans.tit_for_tat:TitForTatHuman",
        "slacking": "cowalk.agents.humans.slacking:SlackingHuman",
        "bounded-memory": "cowalk.agents.humans.bounded_memory:BoundedMemoryHuman",
        "impedance": "cowalk.agents.humans.impedance:ImpedanceHuman",
        "crossover": "cowalk.agents.humans.crossover:CrossoverHuman",
        "game": "cowalk.agents.humans.game:GameHuman",
        "recorded": "cowalk.agents.humans.recorded.human:RecordedHuman",
    },
    "cowalk.humans",
    protocol=Human,
)

IMPERFECTIONS: Registry[Imperfection] = Registry(
    "imperfection",
    {
        "reaction-delay": "cowalk.agents.imperfections.reaction_delay:ReactionDelay",
        "perception-threshold": (
            "cowalk.agents.imperfections.perception_threshold:PerceptionThreshold"
        ),
        "signal-dependent-noise": (
            "cowalk.agents.imperfections.signal_dependent_noise:SignalDependentNoise"
        ),
        "tremor": "cowalk.agents.imperfections.tremor:Tremor",
        "fatigue": "cowalk.agents.imperfections.fatigue:Fatigue",
        "force-limit": "cowalk.agents.imperfections.force_limit:ForceLimit",
        "gait-ripple": "cowalk.agents.imperfections.gait_ripple:GaitRipple",
    },
    "cowalk.imperfections",
    protocol=Human,  # an imperfection is a human around another one
)

AUTOMATIONS: Registry[Automation] = Registry(
    "automation",
    {
        "stubbornness": "cowalk.agents.automations.strategies.stubbornness:StubbornnessAutomation",
        "never-yields": "cowalk.agents.automations.strategies.never_yields:NeverYields",
        "always-yields": "cowalk.agents.automations.strategies.always_yields:AlwaysYields",
    },
    "cowalk.automations",
    protocol=Automation,
)
