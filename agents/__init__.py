"""Who decides: human models, automations, and the registries that find them by name."""

from .checks import check_automation, check_human
from .interfaces import Automation, Belief, Human, Observation, Situation, Truth
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
