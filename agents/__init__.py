"""Who decides: human models, automations, and the registries that find them by name."""

from cowalk.sim.basics.observation import Observation
from cowalk.sim.basics.situation import Situation

from .basics.protocols import Automation, Belief, Human, Truth
from .checks.conformance import check_automation, check_human
from .registry import AUTOMATIONS, HUMANS, IMPERFECTIONS

__all__ = [
    "AUTOMATIONS",
    "HUMANS",
    "IMPERFECTIONS",
    "Automation",
    "Belief",
    "Human",
    "Observation",
    "Situation",
    "Truth",
    "check_automation",
    "check_human",
]
