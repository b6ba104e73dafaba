"""The robot that ships or a user's own: its bodies, drive, wheels and coupling."""
