"""The paper's plant: a unicycle that executes its command exactly."""
