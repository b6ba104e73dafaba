"""The human models and automations that ship, by name."""

from __future__ import annotations

from cowalk.sim.registry import Registry

from .interfaces import Automation, Human

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
        "recorded": "cowalk.agents.humans.recorded:RecordedHuman",
    },
    "cowalk.humans",
    methods=("reset", "act", "truth"),
)

AUTOMATIONS: Registry[Automation] = Registry(
    "automation",
    {
        "stubbornness": "cowalk.agents.automations.stubbornness:StubbornnessAutomation",
        "never-yields": "cowalk.agents.automations.constant:NeverYields",
        "always-yields": "cowalk.agents.automations.constant:AlwaysYields",
    },
    "cowalk.automations",
    methods=("reset", "act", "belief"),
)
