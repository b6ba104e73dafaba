"""The laws that human models share."""
