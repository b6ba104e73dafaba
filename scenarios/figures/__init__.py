"""Pictures of runs, people and the paper."""
