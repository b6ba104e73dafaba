"""The two bodies of the PyBullet plant in closed form, for many runs."""
