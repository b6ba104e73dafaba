"""Checks that find what is wrong with a class of one's own before it spoils a run."""
