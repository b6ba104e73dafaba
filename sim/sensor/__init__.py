"""The force-torque sensor: its faults, presets, channels, filter and transmission."""
