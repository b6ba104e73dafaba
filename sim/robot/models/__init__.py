"""Bodies of the PyBullet plant: URDF files, found with `importlib.resources`."""
