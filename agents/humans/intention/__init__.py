"""Where a human wants to go, and how the aim moves."""
