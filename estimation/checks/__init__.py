"""Checks that find what is wrong with an estimator of one's own before it spoils a run."""
