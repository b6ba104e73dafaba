"""The kinematic plant of the paper."""
