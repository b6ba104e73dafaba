"""The only door to PyBullet, opened when it is first asked for."""
