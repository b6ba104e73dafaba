"""Smoothers of a value sampled once a negotiation, one file each."""
