"""The protocols of both seats, and functions for one agent or a batch."""
