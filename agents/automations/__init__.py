"""Automations: the strategies by which they concede, and the planner they negotiate with."""
