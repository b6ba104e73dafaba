"""Scenario files: found, read, checked with their lines, written back."""
