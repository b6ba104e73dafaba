"""A human whose force is read from a file."""
