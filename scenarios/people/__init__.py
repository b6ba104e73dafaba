"""Populations: people drawn, and how they respond."""
