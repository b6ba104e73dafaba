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
