"""What writes results to files."""
