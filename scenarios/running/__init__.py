"""A scenario built and run."""
