"""Automations, one file a strategy; `cowalk.agents.registry` finds them by name."""
