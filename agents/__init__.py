"""Who decides: human models, automations, and the registries that find them by name."""

from .interfaces import Automation, Belief, Human, Observation, Situation, Truth
from .registry import AUTOMATIONS, HUMANS

__all__ = [
    "AUTOMATIONS",
    "HUMANS",
    "Automation",
    "Belief",
    "Human",
    "Observation",
    "Situation",
    "Truth",
]
