"""The protocols of both seats, and laws' functions for one agent or a batch."""
