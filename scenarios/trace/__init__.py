"""What a run leaves behind: trace, metrics, result."""
