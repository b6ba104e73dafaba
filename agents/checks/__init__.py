"""Checks for classes of one's own."""
