"""A scenario is built and run here, one control step after the other."""
